#pragma once

// What the timeline shows in which line: of each person, of the stage and of each object
// the items that are written, and what the script did by itself.

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "shared/drama/drama.h"
#include "shared/drama/interval_index.h"
#include "shared/drama/timeline_text.h"

namespace lararium::panels {

struct TimelineRow {
  enum class Kind {
    kHeading,  // of a group
    kItems,    // written in track{...}
    kBlocks,   // what the script did in the dry run
  };
  Kind kind = Kind::kHeading;
  std::string group;  // a person, an object; "" the stage
  bool of_object = false;
  drama::LaneKind lane = drama::LaneKind::kMarkers;
  std::vector<size_t> lanes;     // of the text, for kItems
  std::vector<uint32_t> blocks;  // numbers of tasks, for kBlocks
  drama::IntervalIndex index;    // of these blocks
};

// The rows of all groups: people in this order, then others who are on the timeline, the
// stage, and the objects that were used. text may be nullptr.
std::vector<TimelineRow> MakeRows(const drama::TimelineText* text,
                                  std::span<const std::string> people,
                                  std::span<const drama::TaskRecord> tasks);

// What a group is remembered by: people, the stage and objects may have the same names.
std::string KeyOfGroup(const TimelineRow& row);

// The line of "drama.lua:12"; 0: there is none. Also of messages that begin with such a place
// and go on with ": " or a column.
int LineOfPlace(std::string_view place, std::string_view file);

}  // namespace lararium::panels
