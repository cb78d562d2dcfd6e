#include "editor/panels/timeline/timeline_selection.h"

namespace lararium::panels {

void TimelineSelection::SelectItem(const drama::TimelineItem& item) {
  items_ = {item};
  last_ = item;
  block_.reset();
}

void TimelineSelection::SelectAll(const drama::TimelineText& text) {
  items_.clear();
  block_.reset();
  for (size_t lane = 0; lane < text.lanes().size(); ++lane) {
    for (size_t item = 0; item < text.lanes()[lane].size(); ++item) {
      items_.push_back({lane, item});
    }
  }
}

void TimelineSelection::SelectBlock(uint32_t block, std::string group) {
  items_.clear();
  block_ = block;
  block_group_ = std::move(group);
}

void TimelineSelection::KeepValid(const drama::TimelineText* text) {
  if (text != nullptr) {
    editor::KeepValid(*text, items_);
  } else {
    items_.clear();
  }
}

std::optional<TimelineStop> TimelineSelection::Last() const {
  if (last_ && editor::Contains(items_, *last_)) {
    return TimelineStop{last_};
  }
  if (!items_.empty()) {
    return TimelineStop{items_.back()};
  }
  return block_ ? std::optional(TimelineStop{std::nullopt, *block_, block_group_}) : std::nullopt;
}

}  // namespace lararium::panels
