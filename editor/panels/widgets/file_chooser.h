#pragma once

// Asks the user for a file: by the desktop's own dialog, or by a list of our own where the desktop
// has none.

#include <imgui.h>

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "editor/desktop/file_places.h"
#include "editor/desktop/file_portal.h"
#include "editor/panels/widgets/file_kinds.h"
#include "editor/panels/widgets/file_list.h"
#include "editor/panels/widgets/widgets.h"
#include "editor/session/recent_projects.h"

namespace lararium::panels {

// One for the window. ImGui's context refers to it, so that every field finds it.
class FileChooser {
 public:
  // parent_window: see FilePortal::Open(). Must outlive the current ImGui context's frames.
  explicit FileChooser(std::string parent_window);
  FileChooser(const FileChooser&) = delete;
  FileChooser& operator=(const FileChooser&) = delete;
  ~FileChooser();

  // The chooser of the current ImGui context.
  static FileChooser& Current();

  // Call before each of ImGui's frames. A dialog whose field was not drawn in the last frame is
  // closed.
  void BeginFrame();

  // The recent projects, which the list offers.
  void SetRecent(const std::vector<editor::RecentProject>& recent) { recent_ = recent; }

  // Asks for a file on behalf of a field. path: the folder, or a file in the folder, that is shown
  // first.
  void Ask(ImGuiID field, FileType type, const std::filesystem::path& path);
  // Shows the list if it is open for the field. Call in each frame in which the field is drawn.
  // Returns the file in the frame in which it was chosen.
  std::optional<std::filesystem::path> Show(ImGuiID field);
  // Whether the desktop's dialog is open for the field.
  bool IsWaiting(ImGuiID field) const { return asked_ && asked_->field == field && !asked_->list; }
  // Why the last choice for the field cannot be used; empty: it can.
  std::string Problem(ImGuiID field) const { return refused_ == field ? problem_ : ""; }
  void ForgetProblem() { refused_ = 0; }

  // Offers a dropped file to the fields of this frame and the next.
  void Drop(const std::filesystem::path& file);
  // The dropped file, once, if it is of that type.
  std::optional<std::filesystem::path> TakeDrop(FileType type);
  // Whether fields can still take the dropped file, and whether one has.
  bool OffersDrop() const { return drop_frames_ > 0; }
  bool drop_taken() const { return drop_taken_; }

 private:
  struct Asked {
    ImGuiID field = 0;
    FileType type = FileType::kFolder;
    bool list = false;   // The list is shown, because the desktop has no dialog.
    bool drawn = false;  // Show() was called for the field in this frame.
  };

  const FileTypeSpec& spec() const { return SpecOf(asked_->type); }
  void OpenList();
  // Shows another folder in the list.
  void Enter(const std::filesystem::path& folder);
  void Read();
  void Choose(size_t entry);
  void HandleKeys();
  void DrawPath();
  void DrawPlaces();
  void DrawEntries();
  void DrawEntry(size_t index);
  void DrawFilter();
  DialogProblem ListProblem() const;
  bool Enters(const std::filesystem::path& target) const;
  const char* Action() const;
  // What the list would return now.
  std::filesystem::path Target() const;
  void DrawList();
  std::optional<std::filesystem::path> ShowList();

  editor::FilePortal portal_;
  std::string parent_window_;
  std::vector<editor::RecentProject> recent_;
  std::optional<Asked> asked_;
  std::map<FileType, std::filesystem::path> last_;  // The folder of the last choice of a type.
  ImGuiID refused_ = 0;                             // The field that problem_ is about.
  std::string problem_;
  std::filesystem::path dropped_;
  int drop_frames_ = 0;  // Frames for which the dropped file is offered.
  bool drop_taken_ = false;

  // What the list shows.
  struct List {
    std::filesystem::path folder;
    std::string typed;  // The path field.
    std::string name;   // The name of a file to write.
    std::vector<FileEntry> entries;
    std::string problem;  // Why the folder cannot be read.
    std::vector<editor::FilePlace> places;
    std::vector<editor::RecentProject> recent;  // The recent projects that exist.
    std::optional<size_t> chosen;
    bool all = false;  // All files are listed, not only those of the type.
    bool scroll = false;
    // The answer. The list is closed one frame later, so that the dialog below does not take the
    // same Enter as its own.
    std::optional<std::filesystem::path> result;
    FileColumn column = FileColumn::kName;
    bool descending = false;
    TypeAhead ahead;
  };
  List list_;
};

}  // namespace lararium::panels
