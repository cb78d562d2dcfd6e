#pragma once

// Where people went while a drama was played dry.

#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <vector>

#include "shared/stage/stage.h"

namespace lararium::app {

struct TrailPoint {
  double seconds = 0.0;               // of the drama
  glm::vec2 place = glm::vec2(0.0f);  // on the stage's floor: (x, z), metres
  float heading = 0.0f;               // radians
  bool appears = false;               // nobody walked here: the drama placed them
};

// One person's way through a drama. Between two points, which are at least kTrailStep apart, they
// went nearly straight and evenly, or stood: whoever stands leaves no points.
struct Trail {
  std::string actor;
  std::vector<TrailPoint> points;  // in the order of time

  // nullopt before they were on the stage for the first time.
  std::optional<TrailPoint> At(double seconds) const;
  // From a moment to another, both included, without what was before they were placed in between.
  std::vector<TrailPoint> Between(double from, double to) const;
};
inline constexpr double kTrailStep = 0.1;  // seconds

// Notes the trails of everybody on a stage.
class TrailRecorder {
 public:
  // Borrows it.
  explicit TrailRecorder(const stage::Stage& stage) : stage_(stage) {}

  // After each tick, and once before the first.
  void Note(double seconds);
  // In the order of the stage's actors.
  std::vector<Trail> Take();

 private:
  struct Going {
    Trail trail;
    std::optional<TrailPoint> last;  // of the tick before; none: not on the stage
  };
  void Note(const TrailPoint& now, Going& going);

  const stage::Stage& stage_;
  std::vector<Going> going_;  // of each actor
};

}  // namespace lararium::app
