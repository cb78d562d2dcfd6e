#pragma once

// The desktop's own file dialog: org.freedesktop.portal.FileChooser of xdg-desktop-portal, over the
// session's D-Bus. Nothing here waits: Update() handles what has arrived.

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace lararium::editor {

// A choice of the dialog's list of kinds, such as "Videos". Extensions have the dot, lower case.
struct FileFilter {
  std::string label;
  std::vector<std::string> extensions;
};

// What the user is asked for.
struct FileRequest {
  enum class Kind { kFile, kFolder, kSave };
  Kind kind = Kind::kFile;
  std::string title;
  std::vector<FileFilter> filters;  // All files can be chosen too.
  std::filesystem::path folder;     // The folder that is shown first.
  std::string name;                 // kSave: the proposed name.
};

struct FileAnswer {
  // kRefused: the user has chosen what cannot be used, such as a file on another computer.
  // kFailed: there was no dialog, or it ended without an answer.
  enum class Outcome { kChosen, kCancelled, kRefused, kFailed };
  Outcome outcome = Outcome::kFailed;
  std::filesystem::path file;
  std::string problem;  // kRefused, kFailed: why.
};

// The pattern of a filter for any case of the letters: "*.[mM][pP]4" for ".mp4".
std::string AnyCasePattern(const std::string& extension);

class FilePortal {
 public:
  // Begins to ask the session's bus for the portal. timeout: the portal counts as missing if it has
  // not answered a call after this time. (A user may take any time.)
  explicit FilePortal(std::chrono::milliseconds timeout = std::chrono::seconds(3));
  FilePortal(const FilePortal&) = delete;
  FilePortal& operator=(const FilePortal&) = delete;
  ~FilePortal();

  // Handles what has arrived. Call once in each frame.
  void Update();

  // Opens the desktop's dialog, and closes the one that is open. Where there is no portal, or it
  // cannot choose folders, TakeAnswer() gives kFailed. parent_window: as the portal identifies
  // windows ("x11:2a00003"); may be empty.
  void Open(const FileRequest& request, const std::string& parent_window);
  // Closes the dialog; there will be no answer.
  void Close();
  // Whether a dialog is open, or an answer was not taken.
  bool busy() const;

  // The answer to the last Open(), once.
  std::optional<FileAnswer> TakeAnswer();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace lararium::editor
