#pragma once

// Keeps what was edited since the last saving: after each edit the document is
// written beside the project, away from the interface thread. What a crash
// leaves there is offered at the next start.

#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include "editor/app/project.h"
#include "shared/core/mailbox.h"

namespace lararium::app {

class Autosave {
 public:
  explicit Autosave(ProjectPaths paths);
  // Writes what is still waiting.
  ~Autosave();
  Autosave(const Autosave&) = delete;
  Autosave& operator=(const Autosave&) = delete;

  // Writes the document soon; of several in quick succession the last one.
  void Write(std::shared_ptr<const ProjectDocument> document);
  // The document is saved: removes the file, soon.
  void Discard();

  // What went wrong since the last call.
  Status TakeStatus();

 private:
  void Run();

  ProjectPaths paths_;
  Mailbox<std::shared_ptr<const ProjectDocument>> mailbox_;  // nullptr: discard
  std::mutex mutex_;
  Status status_;
  std::jthread thread_;
};

// What a crash left: nullopt where there is nothing, an error where it cannot be
// read (it is left where it is).
Result<std::optional<ProjectDocument>> LoadAutosave(const ProjectPaths& paths);

}  // namespace lararium::app
