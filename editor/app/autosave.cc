#include "editor/app/autosave.h"

#include <utility>

namespace lararium::app {

Autosave::Autosave(ProjectPaths paths) : paths_(std::move(paths)), thread_([this] { Run(); }) {}

Autosave::~Autosave() {
  mailbox_.Close();
  thread_.join();
}

void Autosave::Write(std::shared_ptr<const ProjectDocument> document) {
  mailbox_.Put(std::move(document));
}

void Autosave::Discard() { mailbox_.Put(nullptr); }

Status Autosave::TakeStatus() {
  const std::lock_guard lock(mutex_);
  return std::exchange(status_, Status());
}

void Autosave::Run() {
  while (const auto document = mailbox_.Take({})) {
    Status status;
    if (*document != nullptr) {
      status = SaveJson(paths_.Autosave(), FormatProject(**document));
    } else {
      std::error_code error;
      std::filesystem::remove(paths_.Autosave(), error);
      if (error) {
        status = Status::Error(paths_.Autosave().string(), "cannot be removed: " + error.message());
      }
    }
    const std::lock_guard lock(mutex_);
    status_ = std::move(status);
  }
}

Result<std::optional<ProjectDocument>> LoadAutosave(const ProjectPaths& paths) {
  std::error_code ignored;
  if (!std::filesystem::exists(paths.Autosave(), ignored)) {
    return std::optional<ProjectDocument>();
  }
  LARARIUM_ASSIGN_OR_RETURN(const Json json, LoadJson(paths.Autosave()));
  LARARIUM_ASSIGN_OR_RETURN(ProjectDocument document,
                            ParseProject(json, paths.Autosave().string()));
  return std::optional<ProjectDocument>(std::move(document));
}

}  // namespace lararium::app
