#pragma once

// Selection by keys in the timeline: moves along a line, and from line to line, through items and
// blocks.

#include <cstdint>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "editor/check/timeline_edits.h"
#include "editor/panels/timeline/timeline_rows.h"
#include "shared/drama/timeline_text.h"

namespace lararium::panels {

// A stop of the selection: an item, or a block of the script by the number of its task.
struct TimelineStop {
  std::optional<drama::TimelineItem> item;  // Not set: the block.
  uint32_t block = 0;
  // KeyOfGroup() of its row. The use of an object has a block in the row of the person and in that
  // of the object.
  std::string group = {};
  double at = 0.0;  // Begin, seconds.

  bool IsSame(const TimelineStop& other) const {
    return item == other.item && (item || (block == other.block && group == other.group));
  }
};

// A line that is not empty, sorted by time.
struct TimelineLine {
  std::vector<TimelineStop> stops;
  bool shown = true;  // The line's group is not folded.
};

// Whether a row has a stop.
bool HasStop(const TimelineRow& row, const TimelineStop& stop);

// The lines of the rows, in their order. folded: KeyOfGroup() of folded groups.
std::vector<TimelineLine> LinesOf(std::span<const TimelineRow> rows,
                                  const drama::TimelineText& text,
                                  std::span<const drama::TaskRecord> tasks,
                                  const std::set<std::string>& folded);

// A move by key: along: the number of stops within the line, below 0 to earlier ones. across: -1 to
// the line above, 1 to the line below.
struct TimelineStep {
  int along = 0;
  int across = 0;
  bool items = false;  // Skips blocks.
};

// Moves from the last selection. Skips the lines of folded groups; in another line it takes the
// stop that is nearest in time; at an end it stays. Without a selection, or where it no longer
// exists: the stop of the first line that is nearest to time, seconds. nullopt: there is nothing to
// select.
std::optional<TimelineStop> StepFrom(std::span<const TimelineLine> lines,
                                     const std::optional<TimelineStop>& chosen,
                                     double time,
                                     const TimelineStep& step);

// Extends the selection by a step. A step back onto a selected item removes the item where it
// starts.
void Extend(editor::ItemSet& chosen,
            const std::optional<drama::TimelineItem>& from,
            const drama::TimelineItem& to);

}  // namespace lararium::panels
