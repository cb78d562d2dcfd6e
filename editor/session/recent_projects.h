#pragma once

// The recently opened projects, newest first, for the start page. They are stored in a file of the
// user that several windows may change.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "shared/core/status.h"

namespace lararium::editor {

struct RecentProject {
  std::filesystem::path folder;  // An absolute path.
  std::string title;
  int64_t opened = 0;  // Seconds since 1970, UTC.
};

class RecentProjects {
 public:
  static constexpr size_t kMost = 24;  // Older entries are removed.

  // Empty before Reload().
  explicit RecentProjects(std::filesystem::path file) : file_(std::move(file)) {}

  const std::vector<RecentProject>& entries() const { return entries_; }

  // Reads the file, if it exists. A file that cannot be read is moved aside by SetAside(), which
  // gives the error; entries() is then empty.
  Status Reload();

  // Each of these reads the file again, because other windows may have changed it, changes one
  // entry and writes the file. On an error entries() has the change, but the file may not have it.
  Status NoteOpened(const RecentProject& project);
  Status Forget(const std::filesystem::path& folder);
  // Changes the folder of a project that was moved.
  Status Move(const std::filesystem::path& from, const std::filesystem::path& to);

 private:
  Status Save() const;

  std::filesystem::path file_;
  std::vector<RecentProject> entries_;
};

}  // namespace lararium::editor
