#pragma once

// The walks of a drama as paths over the floor of the stage: as recorded in the dry run, or as
// planned if that run is out of date. Points on the floor are (x, z) of the stage, metres.

#include <cstdint>
#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <vector>

#include "editor/check/drama_run.h"
#include "shared/core/status.h"
#include "shared/drama/timeline_text.h"

namespace lararium::editor {

// A point that an item of the timeline states.
struct WalkPoint {
  glm::vec2 place = glm::vec2(0.0f);
  std::optional<float> heading;  // Radians.
};

struct WalkPath {
  std::string actor;
  std::optional<drama::TimelineItem> item;  // Item that starts the walk; none if the script does.
  std::optional<uint32_t> task;             // Task of the run; none if the path is planned.
  double begins = 0.0;                      // Seconds of the drama.
  std::optional<WalkPoint> from;            // Position where the item places the person first.
  std::optional<WalkPoint> to;              // Destination of the item.
  // Points from begin to end; a planned path has no times. Empty if the begin is unknown.
  std::vector<TrailPoint> way;
  std::string problem;  // Reason why the person does not arrive; empty if they do.
};

// The fields of an item that hold points of its walk.
inline constexpr const char* kWalkFrom = "from";
inline constexpr const char* kWalkTo = "to";

// The point in one of these fields; nullopt if it is not given in numbers.
std::optional<WalkPoint> WalkPointOf(const drama::TimelineText& text,
                                     const drama::TimelineItem& item,
                                     const char* field);

// All walks of one person, those of the timeline before those of the script. `text` and `run`
// may be nullptr. `run_is_current` says that the run used this text.
std::vector<WalkPath> FindWalkPaths(const drama::TimelineText* text,
                                    const DramaRun* run,
                                    bool run_is_current,
                                    const std::string& actor);

// Plans the same walk to another destination, with all doors open and without other people.
void PlanWalk(const DramaRun* run, glm::vec2 to, WalkPath& walk);

// The begins and ends of walks of the timeline, as targets for snapping.
std::vector<glm::vec2> WalkMarks(const drama::TimelineText& text,
                                 std::optional<drama::TimelineItem> except);

// Changes an existing point of the item; rounds to millimetres. Fails if the item does not have
// the point.
Status SetWalkPlace(drama::TimelineText& text,
                    const drama::TimelineItem& item,
                    const char* field,
                    glm::vec2 place);

// Snaps a position to the nearest of `marks` within `reach` (metres), otherwise to a grid with
// spacing `step` (metres) through the origin of the stage.
glm::vec2 SnapOnFloor(glm::vec2 place,
                      float step,
                      const std::vector<glm::vec2>& marks,
                      float reach);

}  // namespace lararium::editor
