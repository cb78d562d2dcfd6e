#pragma once

// The guided tour of the sample, step by step. Each step recognises from the project and the window
// whether it was done.

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "editor/panels/widgets/keys.h"

namespace lararium::panels {

// The facts that steps depend on.
struct TourFacts {
  bool trained = false;
  bool picture = false;  // The camera view has a picture.
  bool playing = false;
  bool report = false;   // The training's report is open.
  bool around = false;   // The scene view is open.
  bool matches = false;  // Matches are shown over the picture.
  bool person = false;   // A person is selected.
  std::string stage;     // The pose of the stage, as text.
  std::string light;     // The poses of the probes, as text.
  int64_t script = 0;    // The revision of the script.
  bool can_redo = false;
  bool checked = false;
  bool dirty = false;
  bool exported = false;
};

struct TourStep {
  const char* title;  // English, see Tr()
  const char* text;
  KeyAction key;  // The key for the step; kNone: none.
  bool (*done)(const TourFacts& at_its_begin, const TourFacts& now);
};

std::span<const TourStep> TourSteps();

class Tour {
 public:
  // The current step; nullptr: the tour is not running.
  const TourStep* step() const { return step_ ? &TourSteps()[*step_] : nullptr; }
  size_t number() const { return step_.value_or(0); }  // The first step is 0.
  // The last step is done; only the end has to be shown.
  bool finished() const { return finished_; }

  void Begin(const TourFacts& now);
  // Call once per frame.
  void Update(const TourFacts& now);
  void Skip(const TourFacts& now);
  void End();

 private:
  std::optional<size_t> step_;
  bool finished_ = false;
  TourFacts at_begin_;  // The facts at the beginning of the step.
};

}  // namespace lararium::panels
