#pragma once

// The rows of the timeline: for each person, the stage and each object, the items of the text and
// the actions of the script.

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
    kHeading,  // The heading of a group.
    kItems,    // Items of track{...}.
    kBlocks,   // Actions of the script in the dry run.
  };
  Kind kind = Kind::kHeading;
  std::string group;  // A person or an object; "": the stage.
  bool of_object = false;
  drama::LaneKind lane = drama::LaneKind::kMarkers;
  std::vector<size_t> lanes;     // Lanes of the text, for kItems.
  std::vector<uint32_t> blocks;  // Numbers of tasks, for kBlocks.
  drama::IntervalIndex index;    // The times of these blocks.
};

// The rows of all groups: people in the given order, then other people of the timeline, the stage,
// and the objects that are used. text may be nullptr.
std::vector<TimelineRow> MakeRows(const drama::TimelineText* text,
                                  std::span<const std::string> people,
                                  std::span<const drama::TaskRecord> tasks);

// A unique key of a group: people, the stage and objects can have the same names.
std::string KeyOfGroup(const TimelineRow& row);

// The line number in a location "drama.lua:12", also where ": " or a column follows; 0: there is
// none.
int LineOfPlace(std::string_view place, std::string_view file);

}  // namespace lararium::panels
