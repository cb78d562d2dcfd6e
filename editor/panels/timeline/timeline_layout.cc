#include "editor/panels/timeline/timeline_layout.h"

#include <algorithm>
#include <span>

#include "editor/panels/widgets/theme.h"

namespace lararium::panels {

TimelineLayout::Change TimelineLayout::Refresh(const editor::Workspace& workspace) {
  const editor::ScriptDocument& script = workspace.project().script();
  const std::vector<editor::CastDocument>& cast = workspace.project().document().cast;
  const bool new_run = workspace.dry_run().number() != run_;
  if (script.revision() == script_ && !new_run && cast.size() == cast_) {
    LayOut();
    return {};
  }
  script_ = script.revision();
  run_ = workspace.dry_run().number();
  cast_ = cast.size();
  std::vector<std::string> people;
  for (const editor::CastDocument& member : cast) {
    people.push_back(member.name);
  }
  const std::span<const drama::TaskRecord> tasks =
      workspace.dry_run().newest() != nullptr
          ? std::span<const drama::TaskRecord>(workspace.dry_run().newest()->tasks)
          : std::span<const drama::TaskRecord>();
  rows_ = MakeRows(script.timeline(), people, tasks);
  if (new_run && !objects_folded_at_first_ && !tasks.empty()) {
    objects_folded_at_first_ = true;
    for (const TimelineRow& row : rows_) {
      if (row.of_object) {
        folded_.insert(KeyOfGroup(row));
      }
    }
  }
  LayOut();
  return {true, new_run};
}

void TimelineLayout::LayOut() {
  constexpr float kSpeech = 42.0f;  // Height of a row of speech, logical pixels.
  shown_.clear();
  tops_ = {0.0f};
  bool folded = false;
  for (const TimelineRow& row : rows_) {
    if (row.kind == TimelineRow::Kind::kHeading) {
      folded = IsFolded(row);
    } else if (folded) {
      continue;
    }
    shown_.push_back(&row);
    const bool speech =
        row.kind != TimelineRow::Kind::kHeading && row.lane == drama::LaneKind::kSpeech;
    tops_.push_back(tops_.back() + Px(speech ? kSpeech : kRow));
  }
}

int TimelineLayout::RowAt(float y) const {
  const auto behind = std::upper_bound(tops_.begin(), tops_.end(), y);
  return behind == tops_.begin() || behind == tops_.end()
             ? -1
             : static_cast<int>(behind - tops_.begin()) - 1;
}

void TimelineLayout::Fold(const TimelineRow& row) {
  const std::string key = KeyOfGroup(row);
  if (folded_.erase(key) == 0) {
    folded_.insert(key);
  }
}

void TimelineLayout::FoldAll() {
  const bool unfold = std::any_of(rows_.begin(), rows_.end(),
                                  [&](const TimelineRow& row) { return IsFolded(row); });
  folded_.clear();
  for (const TimelineRow& row : rows_) {
    if (!unfold) {
      folded_.insert(KeyOfGroup(row));
    }
  }
}

}  // namespace lararium::panels
