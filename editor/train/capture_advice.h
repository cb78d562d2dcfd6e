#pragma once

// Advice on what to film next and reasons why frames are weak, as data and as sentences.

#include <string>

#include "shared/core/sentence.h"

namespace lararium::train {

enum class WeakReason {
  kFewFeatures,
  kBlur,
  kFastMotion,
  kNotLocated,  // None of the reasons above applies.
  kFewPoints,   // The frame was located, but with few points.
};
Sentence Title(WeakReason reason);
Sentence Remedy(WeakReason reason);

// The distance that the person who films should walk.
struct WalkDistance {
  double value = 0.0;      // Metres, or a share of the distance to the scene.
  bool in_metres = false;  // True if the map's scale is known.

  friend bool operator==(const WalkDistance&, const WalkDistance&) = default;
};

// One piece of advice. A stretch of frames is given by the names of its first and last frames,
// which may be the same. The comments of Kind say which other fields are set.
struct CaptureAdvice {
  enum class Kind {
    kEnough,      // nothing is missing
    kNotLocated,  // first, last, reason
    kShortGaps,   // value: number of stretches of one or two frames that could not be located
    kOneSide,     // first, last, end, walk; value: degrees between the viewing directions
    // A visitor who leaves the path by this step is located poorly. first, last, end; walk: length
    // of the step; value: number of points found again.
    kStepLeft,
    kStepRight,
    kStepNearer,
    kStepBack,
    // A visitor who turns on the spot is located poorly. Same fields, without walk.
    kTurnLeft,
    kTurnRight,
    kFocal,         // value: standard deviation of the focal length, percent
    kFewKeyframes,  // value: number of keyframes in the map
    kExposure,      // value: change of the exposure in stops; session
    kLookalikes,    // Nothing in the stretch tells it from other parts. first, last, end
    // Parts of the place look alike, and the images have no order that tells them apart. value:
    // share of what the images show that other parts have too, percent
    kUnordered,
    kWritten,  // The field `text` is a whole sentence; the report has no name for the kind.
  };
  // The end of the plan at which a stretch lies.
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
// The advice as a sentence for people.
Sentence AdviceSentence(const CaptureAdvice& advice);

}  // namespace lararium::train
