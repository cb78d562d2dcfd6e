#pragma once

// Keeps two windows from editing one project at the same time: each would take the other's journal
// for the edits of a window that was killed.

#include <filesystem>

#include "editor/document/project_paths.h"
#include "shared/core/status.h"

namespace lararium::editor {

// Held while a window has the project open. The system releases it when a program is killed.
// Move-only.
class ProjectLock {
 public:
  // The error says who has the project open, on which machine. Where a file system has no locks,
  // the project is opened without one.
  static Result<ProjectLock> Take(const ProjectPaths& paths);

  ProjectLock(ProjectLock&& other) noexcept;
  ProjectLock& operator=(ProjectLock&& other) noexcept;
  ~ProjectLock();

  // The folder cannot be written, so that no edit can be saved.
  bool read_only() const { return read_only_; }

 private:
  ProjectLock() = default;

  std::filesystem::path file_;
  int descriptor_ = -1;
  bool read_only_ = false;
};

}  // namespace lararium::editor
