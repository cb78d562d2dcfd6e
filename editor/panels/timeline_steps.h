#pragma once

// What keys choose in the timeline, one after the other: items along their line and from line to
// line, and what the script did.

#include <cstdint>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "editor/app/timeline_edits.h"
#include "editor/panels/timeline_rows.h"
#include "shared/drama/timeline_text.h"

namespace lararium::panels {

// What can be chosen: an item, or a block of the script by the number of its task.
struct TimelineStop {
  std::optional<drama::TimelineItem> item;  // none: the block is meant
  uint32_t block = 0;
  // KeyOfGroup() of where it lies: somebody who uses an object has a block there and with it.
  std::string group = {};
  double at = 0.0;  // seconds, where it begins

  bool IsSame(const TimelineStop& other) const {
    return item == other.item && (item || (block == other.block && group == other.group));
  }
};

// A line with something in it, by time.
struct TimelineLine {
  std::vector<TimelineStop> stops;
  bool shown = true;  // its group is not folded
};

// Of the rows in their order. folded: KeyOfGroup() of groups.
std::vector<TimelineLine> LinesOf(std::span<const TimelineRow> rows,
                                  const drama::TimelineText& text,
                                  std::span<const drama::TaskRecord> tasks,
                                  const std::set<std::string>& folded);

// Where a key goes: so many stops further in the line (before it: below 0), or else to the line
// above (below 0) or below.
struct TimelineStep {
  int along = 0;
  int across = 0;
  bool items = false;  // blocks are passed over
};

// From what was chosen last. Lines of folded groups are passed over; of another line it is what
// lies nearest in time; at either end it stays. Nothing was chosen, or it is not there any more:
// what is nearest to a time, seconds, in the first line. nullopt: nothing can be chosen.
std::optional<TimelineStop> StepFrom(std::span<const TimelineLine> lines,
                                     const std::optional<TimelineStop>& chosen,
                                     double time,
                                     const TimelineStep& step);

// A step that adds to what is chosen: back over what it has already, it takes away where it comes
// from.
void Extend(app::ItemSet& chosen,
            const std::optional<drama::TimelineItem>& from,
            const drama::TimelineItem& to);

}  // namespace lararium::panels
