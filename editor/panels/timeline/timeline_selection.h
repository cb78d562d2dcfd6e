#pragma once

// The selection in the timeline: items of the text, or a task of the dry run.

#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "editor/check/timeline_edits.h"
#include "editor/panels/timeline/timeline_steps.h"
#include "shared/drama/timeline_text.h"

namespace lararium::panels {

class TimelineSelection {
 public:
  const editor::ItemSet& items() const { return items_; }
  // The selected task of the dry run.
  const std::optional<uint32_t>& block() const { return block_; }
  bool HasItems() const { return !items_.empty(); }

  void SetItems(editor::ItemSet items) { items_ = std::move(items); }
  void Toggle(const drama::TimelineItem& item) { editor::Toggle(items_, item); }
  // Selects a single item, from which keys step on.
  void SelectItem(const drama::TimelineItem& item);
  void SelectAll(const drama::TimelineText& text);
  // group: KeyOfGroup() of the row in which the task is selected.
  void SelectBlock(uint32_t block, std::string group);
  void ClearItems() { items_.clear(); }
  void ClearBlock() { block_.reset(); }
  // Removes items that no longer exist. text may be nullptr.
  void KeepValid(const drama::TimelineText* text);

  // The start of a step by key: the item that was selected last, or the task.
  std::optional<TimelineStop> Last() const;

 private:
  editor::ItemSet items_;
  // The last item that was selected alone; it may no longer exist.
  std::optional<drama::TimelineItem> last_;
  std::optional<uint32_t> block_;
  std::string block_group_;  // KeyOfGroup() of the row in which block_ is selected.
};

}  // namespace lararium::panels
