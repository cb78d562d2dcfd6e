#pragma once

// What is to be filmed next, and why frames are weak: kinds and numbers, and the sentences that
// they make.

#include <string>

#include "shared/core/sentence.h"

namespace lararium::train {

enum class WeakReason {
  kFewFeatures,
  kBlur,
  kFastMotion,
  kNotLocated,  // for none of the reasons above
  kFewPoints,   // located, but hardly
};
Sentence Title(WeakReason reason);
Sentence Remedy(WeakReason reason);

// How far somebody is to walk.
struct WalkDistance {
  double value = 0.0;      // metres, or a share of the distance to what is seen
  bool in_metres = false;  // the map's scale is known

  friend bool operator==(const WalkDistance&, const WalkDistance&) = default;
};

// What to film next, or what to do otherwise when filming. Stretches are named by their first and
// last frames, which may be one.
struct CaptureAdvice {
  enum class Kind {
    kEnough,        // nothing is missing
    kNotLocated,    // frames, reason
    kShortGaps,     // value: how many stretches of one or two frames could not be located
    kOneSide,       // frames, end, walk; value: degrees between the directions of sight
    kStepLeft,      // where a visitor who leaves the path so is located poorly: frames, end,
    kStepRight,     //   walk: the step; value: points found again
    kStepNearer,    //
    kStepBack,      //
    kTurnLeft,      // the same of a turn where they stand; no walk
    kTurnRight,     //
    kFocal,         // value: standard deviation of the focal length, percent
    kFewKeyframes,  // value: how many shape the map
    kExposure,      // value: stops by which it changed; session
    kWritten,       // text: a whole sentence, as reports of earlier versions have it
  };
  // Of the plan, that a stretch lies at.
  enum class End { kNone, kLeft, kRight, kNear, kFar };

  Kind kind = Kind::kEnough;
  std::string first = {};
  std::string last = {};
  End end = End::kNone;
  WeakReason reason = WeakReason::kNotLocated;
  double value = 0.0;
  WalkDistance walk = {};
  int session = 0;
  std::string text = {};

  friend bool operator==(const CaptureAdvice&, const CaptureAdvice&) = default;
};
// As people read it.
Sentence AdviceSentence(const CaptureAdvice& advice);

}  // namespace lararium::train
