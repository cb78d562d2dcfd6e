#include "editor/panels/timeline/timeline_rows.h"

#include <algorithm>
#include <charconv>
#include <map>
#include <utility>

namespace lararium::panels {

using drama::LaneKind;
using drama::TaskRecord;

namespace {

// The kinds of lanes in the order of their rows.
std::vector<LaneKind> KindsInRows() {
  std::vector<LaneKind> kinds;
  for (const drama::LaneSpec& lane : drama::LaneSpecs()) {
    kinds.push_back(lane.kind);
  }
  std::stable_sort(kinds.begin(), kinds.end(), [](LaneKind a, LaneKind b) {
    return drama::SpecOf(a).row < drama::SpecOf(b).row;
  });
  return kinds;
}

using Blocks = std::vector<uint32_t>;

TimelineRow BlocksRow(const std::string& group,
                      bool of_object,
                      LaneKind lane,
                      Blocks blocks,
                      std::span<const TaskRecord> tasks) {
  TimelineRow row{TimelineRow::Kind::kBlocks, group, of_object, lane, {}, std::move(blocks), {}};
  std::vector<double> begins;
  std::vector<double> lengths;
  for (const uint32_t block : row.blocks) {
    begins.push_back(tasks[block].began);
    lengths.push_back(std::max(tasks[block].ended - tasks[block].began, 0.0));
  }
  row.index.Build(begins, lengths);
  return row;
}

}  // namespace

std::vector<TimelineRow> MakeRows(const drama::TimelineText* text,
                                  std::span<const std::string> people,
                                  std::span<const TaskRecord> tasks) {
  std::vector<std::string> groups(people.begin(), people.end());
  const auto add_group = [&](const std::string& name) {
    if (!name.empty() && std::find(groups.begin(), groups.end(), name) == groups.end()) {
      groups.push_back(name);
    }
  };
  std::map<std::pair<std::string, LaneKind>, std::vector<size_t>> lanes;
  for (size_t i = 0; text != nullptr && i < text->lanes().size(); ++i) {
    const drama::TimelineLane& lane = text->lanes()[i];
    add_group(lane.actor);
    lanes[{lane.actor, lane.kind}].push_back(i);
  }
  std::map<std::pair<std::string, LaneKind>, Blocks> blocks;
  std::map<std::string, Blocks> of_objects;
  for (uint32_t i = 0; i < tasks.size(); ++i) {
    const TaskRecord& task = tasks[i];
    if (!task.from_timeline) {
      add_group(task.actor);
      blocks[{task.actor, drama::LaneOfTask(task.action)}].push_back(i);
    }
    if (!task.object.empty()) {
      of_objects[task.object].push_back(i);
    }
  }
  groups.push_back("");  // The stage.

  const std::vector<LaneKind> kinds = KindsInRows();
  std::vector<TimelineRow> rows;
  for (const std::string& group : groups) {
    rows.push_back({TimelineRow::Kind::kHeading, group, false, LaneKind::kMarkers, {}, {}, {}});
    for (const LaneKind kind : kinds) {
      if (const auto found = lanes.find({group, kind}); found != lanes.end()) {
        rows.push_back({TimelineRow::Kind::kItems, group, false, kind, found->second, {}, {}});
      }
      if (const auto found = blocks.find({group, kind}); found != blocks.end()) {
        rows.push_back(BlocksRow(group, false, kind, std::move(found->second), tasks));
      }
    }
  }
  for (auto& [object, used] : of_objects) {
    rows.push_back({TimelineRow::Kind::kHeading, object, true, LaneKind::kUses, {}, {}, {}});
    rows.push_back(BlocksRow(object, true, LaneKind::kUses, std::move(used), tasks));
  }
  return rows;
}

std::string KeyOfGroup(const TimelineRow& row) {
  return (row.of_object ? "object " : "person ") + row.group;
}

int LineOfPlace(std::string_view place, std::string_view file) {
  const size_t at = place.find(std::string(file) + ":");
  if (at == std::string_view::npos) {
    return 0;
  }
  const std::string_view digits = place.substr(at + file.size() + 1);
  int line = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), line);
  return error == std::errc() && line > 0 ? line : 0;
}

}  // namespace lararium::panels
