#pragma once

// Records the paths of people during a dry run.

#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <vector>

#include "shared/stage/stage.h"

namespace lararium::editor {

struct TrailPoint {
  double seconds = 0.0;               // Time in the drama.
  glm::vec2 place = glm::vec2(0.0f);  // Position on the floor of the stage: (x, z), metres.
  float heading = 0.0f;               // Radians.
  bool appears = false;               // The drama placed the person here; no one walked.
};

// The path of one person through a drama. Between two points, which are at least kTrailStep
// apart, the person walked nearly straight and uniformly, or stood; standing adds no points.
struct Trail {
  std::string actor;
  std::vector<TrailPoint> points;  // Sorted by time.

  // nullopt before the first appearance on the stage.
  std::optional<TrailPoint> At(double seconds) const;
  // The points from one time to another, both included, without those before a placement in
  // between.
  std::vector<TrailPoint> Between(double from, double to) const;
};
inline constexpr double kTrailStep = 0.1;  // seconds

// Records the trails of all people on a stage.
class TrailRecorder {
 public:
  // Keeps a reference to the stage.
  explicit TrailRecorder(const stage::Stage& stage) : stage_(stage) {}

  // Call once before the first tick and after each tick.
  void Note(double seconds);
  // Trails in the order of the actors of the stage.
  std::vector<Trail> Take();

 private:
  struct Going {
    Trail trail;
    // State at the previous tick; none if the person was not on the stage.
    std::optional<TrailPoint> last;
  };
  void Note(const TrailPoint& now, Going& going);

  const stage::Stage& stage_;
  std::vector<Going> going_;  // Indexed by actor.
};

}  // namespace lararium::editor
