#pragma once

// The projects that were opened, newest first, as the start page lists them. They are kept
// in a file of the person, which several windows may change.

#include <cstdint>
#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

#include "shared/core/status.h"

namespace lararium::app {

struct RecentProject {
  std::filesystem::path folder;  // absolute
  std::string title;
  int64_t opened = 0;  // seconds since 1970, UTC

  // Whether there is a project.
  bool Exists() const;
};

class RecentProjects {
 public:
  static constexpr size_t kMost = 24;  // what was opened longer ago is forgotten

  // Knows none before Reload().
  explicit RecentProjects(std::filesystem::path file) : file_(std::move(file)) {}

  const std::vector<RecentProject>& entries() const { return entries_; }

  // Reads the file, if it is there. One that cannot be read is told of and moved aside, as
  // SetAside() does; entries() is then empty.
  Status Reload();

  // Each reads anew what other windows wrote, changes one entry and writes. On an error
  // entries() has the change, but the file may not.
  Status NoteOpened(const RecentProject& project);
  Status Forget(const std::filesystem::path& folder);
  // The project is found at another place.
  Status Move(const std::filesystem::path& from, const std::filesystem::path& to);

 private:
  Status Save() const;

  std::filesystem::path file_;
  std::vector<RecentProject> entries_;
};

// What a project looked like in the camera view when it was left, bgr and at most
// kProjectPictureWidth wide. Kept apart from the project: it is nobody's work.
inline constexpr int kProjectPictureWidth = 480;  // pixels
std::optional<cv::Mat> LoadProjectPicture(const std::filesystem::path& project);
Status SaveProjectPicture(const std::filesystem::path& project, const cv::Mat& bgr);

}  // namespace lararium::app
