#pragma once

// Files that the project names and that are not there, each with a way to locate it.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "editor/app/missing_files.h"
#include "editor/app/workspace.h"

namespace lararium::panels {

class MissingPanel {
 public:
  // Looks at the files now and then: disks come and go.
  void Look(const app::Workspace& workspace);
  int count() const { return static_cast<int>(missing_.size()); }
  // The dialog is open: keys belong to it.
  bool locating() const { return locating_.has_value(); }

  // The list, if there is anything to list, and the dialog that locates one.
  void Show(app::Workspace& workspace);

 private:
  void ShowRow(const app::Workspace& workspace, const app::MissingFile& file);
  void ShowDialog(app::Workspace& workspace);
  void Take(app::Workspace& workspace, std::span<const app::Relocation> moves);
  void FillOffers(const app::Workspace& workspace, const app::Relocation& located);

  std::vector<app::MissingFile> missing_;
  double looked_ = -1.0;  // seconds, ImGui's clock; below 0: look at once
  std::optional<app::MissingFile> locating_;
  std::string typed_;                    // where it is now
  std::string offered_for_;              // what offers_ were worked out for
  std::vector<app::Relocation> offers_;  // others that made the same move
  bool take_offers_ = true;
};

}  // namespace lararium::panels
