#pragma once

// The rows of the timeline as they are laid out: which groups are folded, and where each row is.

#include <cstddef>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "editor/panels/timeline/timeline_rows.h"
#include "editor/session/workspace.h"

namespace lararium::panels {

class TimelineLayout {
 public:
  static constexpr float kRow = 24.0f;  // Height of a row, logical pixels.

  struct Change {
    bool rows = false;  // The rows have been read again.
    bool run = false;   // The dry run is a new one.
  };
  // Reads the rows again if the script, the dry run or the cast has changed, and lays them out.
  Change Refresh(const editor::Workspace& workspace);
  // Lays the rows out after groups were folded or unfolded.
  void LayOut();

  const std::vector<TimelineRow>& rows() const { return rows_; }
  // The rows outside folded groups.
  const std::vector<const TimelineRow*>& shown() const { return shown_; }
  const TimelineRow& Shown(int row) const { return *shown_[static_cast<size_t>(row)]; }
  // The top of a shown row, and the height of all rows; pixels from the top of the first row.
  float Top(size_t row) const { return tops_[row]; }
  float height() const { return tops_.back(); }
  // The index into shown() of the row at a height, pixels; -1: none.
  int RowAt(float y) const;

  // KeyOfGroup() of the folded groups.
  const std::set<std::string>& folded() const { return folded_; }
  bool IsFolded(const TimelineRow& row) const { return folded_.contains(KeyOfGroup(row)); }
  // Folds or unfolds the group of a row.
  void Fold(const TimelineRow& row);
  // Folds all groups, or unfolds all where one is folded.
  void FoldAll();
  void UnfoldPerson(const std::string& name) { folded_.erase("person " + name); }

 private:
  std::vector<TimelineRow> rows_;          // All rows.
  std::vector<const TimelineRow*> shown_;  // The rows outside folded groups.
  std::vector<float> tops_ = {
      0.0f};  // The top of each row, and the bottom of the last one; pixels.
  std::set<std::string> folded_;
  bool objects_folded_at_first_ = false;
  int64_t script_ = -1;  // Revision of the script that rows_ show.
  int64_t run_ = -1;     // Number of the dry run that rows_ show.
  size_t cast_ = 0;      // The number of cast members.
};

}  // namespace lararium::panels
