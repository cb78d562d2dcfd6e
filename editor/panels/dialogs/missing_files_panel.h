#pragma once

// Files that the project refers to but that do not exist, each with a button to locate it.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "editor/document/missing_files.h"
#include "editor/session/workspace.h"

namespace lararium::panels {

class MissingFilesPanel {
 public:
  // Looks for the files at intervals, because disks are connected and removed.
  void Look(const editor::Workspace& workspace);
  int count() const { return static_cast<int>(missing_.size()); }
  // The dialog is open and receives the keys.
  bool locating() const { return locating_.has_value(); }

  // Shows the list, if it is not empty, and the dialog that locates a file.
  void Show(editor::Workspace& workspace);

 private:
  void DrawRow(const editor::Workspace& workspace, const editor::MissingFile& file);
  void DrawDialog(editor::Workspace& workspace);
  void Take(editor::Workspace& workspace, std::span<const editor::Relocation> moves);
  void FillOffers(const editor::Workspace& workspace, const editor::Relocation& located);

  std::vector<editor::MissingFile> missing_;
  // Time of the last look, seconds of ImGui's clock; below 0: look at once.
  double looked_ = -1.0;
  std::optional<editor::MissingFile> locating_;
  std::string typed_;                       // The new path.
  std::string was_;                         // The path that was typed_ at first.
  std::string offered_for_;                 // The path that offers_ belong to.
  std::vector<editor::Relocation> offers_;  // Other files that made the same move.
  bool take_offers_ = true;
};

}  // namespace lararium::panels
