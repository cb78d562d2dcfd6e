#include "editor/session/workspace.h"

#include <utility>

#include "editor/jobs/baking.h"

namespace lararium::editor {

Result<std::unique_ptr<Workspace>> Workspace::Open(ProjectPaths paths, Log& log) {
  auto messages = std::make_unique<MessageLog>();
  LARARIUM_ASSIGN_OR_RETURN(std::unique_ptr<ProjectSession> project,
                            ProjectSession::Open(std::move(paths), *messages));
  return std::unique_ptr<Workspace>(new Workspace(std::move(messages), std::move(project), log));
}

Workspace::Workspace(std::unique_ptr<MessageLog> messages,
                     std::unique_ptr<ProjectSession> project,
                     Log& log)
    : messages_(std::move(messages)),
      project_(std::move(project)),
      map_(*project_, tasks_, *messages_, log),
      training_(*project_, map_, tasks_, *messages_, log),
      cast_(*project_, tasks_, *messages_, baking_),
      probe_pictures_(*project_, tasks_),
      dry_run_(*project_, cast_, tasks_),
      playback_(*project_, dry_run_),
      preview_(*project_, map_, cast_, playback_, tasks_, *messages_, log, baking_),
      jobs_(*project_, preview_, tasks_, *messages_, baking_) {
  project_->Subscribe([this](ProjectSession::Event event) {
    if (event == ProjectSession::Event::kEdited) {
      OrderPictures();
    }
  });
  people_wait_ = PeopleToBake(project_->paths(), project_->document()).empty();
  OrderPictures();
}

bool Workspace::AtLongWork() const {
  return tasks_.Running(TaskKind::kTraining) || tasks_.Running(TaskKind::kExporting);
}

bool Workspace::ShowsPreview() const {
  return !map_.stale() && !tasks_.Running(TaskKind::kOpening) && preview_.ready();
}

// Pictures wait for the preview's first picture, those of objects for the dry run too: each needs
// tens of megabytes, and both processor cores while shaders are compiled. People who are not baked
// do not wait, because ordering their pictures bakes them.
void Workspace::OrderPictures() {
  const bool shows = ShowsPreview();
  people_wait_ &= !shows;
  if (!people_wait_) {
    cast_.pictures().SetCast(project_->document().cast);
  }
  if (shows && !tasks_.Running(TaskKind::kDryRun)) {
    cast_.pictures().SetObjects(project_->document().objects);
  }
}

void Workspace::Update(double seconds) {
  tasks_.Poll();
  map_.Update();
  constexpr double kFilesInterval = 1.0;  // Seconds; other programs can edit the files.
  since_files_checked_ += seconds;
  if (since_files_checked_ > kFilesInterval) {
    since_files_checked_ = 0.0;
    OrderPictures();
    project_->DetectExternalChanges();
    map_.DetectExternalChange();
    preview_.DetectChangedInputs();
  }
  project_->Update(seconds);
  dry_run_.Update(seconds);
  cast_.Update();
  playback_.Advance(seconds);
  preview_.Update(seconds);
}

}  // namespace lararium::editor
