#pragma once

// The guided tour: what to do next in the sample, step by step. Each step knows from the
// project and the window whether it was done.

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "editor/panels/keys.h"

namespace lararium::panels {

// What steps look at.
struct TourFacts {
  bool trained = false;
  bool picture = false;  // the camera view shows one
  bool playing = false;
  bool around = false;   // the view around the place is shown
  bool matches = false;  // over the picture
  bool person = false;   // one is selected
  std::string stage;     // where it lies, as text
  std::string light;     // how the probes lie, likewise
  int64_t script = 0;    // its revision
  bool can_redo = false;
  bool checked = false;
  bool dirty = false;
  bool exported = false;
};

struct TourStep {
  const char* title;  // English, see Tr()
  const char* text;
  KeyAction key;  // that helps; kNone: none
  bool (*done)(const TourFacts& at_its_begin, const TourFacts& now);
};

std::span<const TourStep> TourSteps();

class Tour {
 public:
  // Where the tour is; nullptr: it does not run.
  const TourStep* step() const { return step_ ? &TourSteps()[*step_] : nullptr; }
  size_t number() const { return step_.value_or(0); }  // from 0
  // The last step is done: all that is left is to say so.
  bool finished() const { return finished_; }

  void Begin(const TourFacts& now);
  // Once for each frame.
  void Update(const TourFacts& now);
  void Skip(const TourFacts& now);
  void End();

 private:
  std::optional<size_t> step_;
  bool finished_ = false;
  TourFacts at_begin_;  // of the step
};

}  // namespace lararium::panels
