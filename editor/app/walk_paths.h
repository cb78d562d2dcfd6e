#pragma once

// The walks of a drama as paths over the stage's floor: as people walked them in the dry run, or,
// until that has played them, as they are planned. Points on the floor are (x, z) of the stage,
// metres.

#include <cstdint>
#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <vector>

#include "editor/app/drama_run.h"
#include "shared/core/status.h"
#include "shared/drama/timeline_text.h"

namespace lararium::app {

// A point that an item of the timeline says.
struct WalkPoint {
  glm::vec2 place = glm::vec2(0.0f);
  std::optional<float> heading;  // radians
};

struct WalkPath {
  std::string actor;
  std::optional<drama::TimelineItem> item;  // that tells it; none: the script does
  std::optional<uint32_t> task;   // of the run, in which it was walked; none: it is planned
  double begins = 0.0;            // of the drama, seconds
  std::optional<WalkPoint> from;  // where the item places them first
  std::optional<WalkPoint> to;    // where it sends them
  // From its beginning to its end; of a planned one without times. Empty where nobody knows where
  // it begins.
  std::vector<TrailPoint> way;
  std::string problem;  // why they do not get there; empty: they do
};

// The fields of an item that say a point of its walk.
inline constexpr const char* kWalkFrom = "from";
inline constexpr const char* kWalkTo = "to";

// What an item says in one of them; nullopt where it does not say it in numbers.
std::optional<WalkPoint> WalkPointOf(const drama::TimelineText& text,
                                     const drama::TimelineItem& item,
                                     const char* field);

// All walks of one person, those of the script behind those of the timeline. text, run: may be
// nullptr. run_is_current: it played the text as it is.
std::vector<WalkPath> FindWalkPaths(const drama::TimelineText* text,
                                    const DramaRun* run,
                                    bool run_is_current,
                                    const std::string& actor);

// The same walk to another place, as it is planned: how somebody goes who meets nobody, with all
// doors open.
void PlanWalk(const DramaRun* run, glm::vec2 to, WalkPath& walk);

// The places where walks of the timeline begin and end, for others to be laid onto.
std::vector<glm::vec2> WalkMarks(const drama::TimelineText& text,
                                 std::optional<drama::TimelineItem> except);

// Another place for a point that the item has; rounded to millimetres. Fails where it has none.
Status SetWalkPlace(drama::TimelineText& text,
                    const drama::TimelineItem& item,
                    const char* field,
                    glm::vec2 place);

// A place laid onto the nearest of some marks within reach (metres), otherwise onto a grid through
// the stage's origin. step: of the grid, metres.
glm::vec2 SnapOnFloor(glm::vec2 place,
                      float step,
                      const std::vector<glm::vec2>& marks,
                      float reach);

}  // namespace lararium::app
