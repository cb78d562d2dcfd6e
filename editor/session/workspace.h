#pragma once

// An open project and everything that runs for it: the parts that panels show and command. It knows
// no windows. Use it from one thread only.

#include <memory>
#include <mutex>

#include "editor/jobs/background_task.h"
#include "editor/session/cast_session.h"
#include "editor/session/dry_run_session.h"
#include "editor/session/job_runner.h"
#include "editor/session/map_session.h"
#include "editor/session/map_training.h"
#include "editor/session/message_log.h"
#include "editor/session/playback.h"
#include "editor/session/preview_session.h"
#include "editor/session/probe_pictures.h"
#include "editor/session/product_notes.h"
#include "editor/session/project_session.h"
#include "shared/core/log.h"
#include "shared/core/status.h"

namespace lararium::editor {

class Workspace {
 public:
  // Reads the project, and edits that a crash left unsaved. log must outlive the result.
  static Result<std::unique_ptr<Workspace>> Open(ProjectPaths paths, Log& log);
  Workspace(const Workspace&) = delete;
  Workspace& operator=(const Workspace&) = delete;

  ProjectSession& project() { return *project_; }
  const ProjectSession& project() const { return *project_; }
  MessageLog& messages() { return *messages_; }
  const MessageLog& messages() const { return *messages_; }
  // The work in the background; messages() has its results.
  TaskList& tasks() { return tasks_; }
  const TaskList& tasks() const { return tasks_; }
  MapSession& map() { return map_; }
  const MapSession& map() const { return map_; }
  MapTraining& training() { return training_; }
  CastSession& cast() { return cast_; }
  const CastSession& cast() const { return cast_; }
  ProbePictures& probe_pictures() { return probe_pictures_; }
  ProductNotes& product_notes() { return product_notes_; }
  const DryRunSession& dry_run() const { return dry_run_; }
  Playback& playback() { return playback_; }
  const Playback& playback() const { return playback_; }
  PreviewSession& preview() { return preview_; }
  const PreviewSession& preview() const { return preview_; }
  JobRunner& jobs() { return jobs_; }
  const JobRunner& jobs() const { return jobs_; }

  // Whether work is running that would be lost by closing the window.
  bool AtLongWork() const;
  // Whether the picture changes without input, so that the interface must redraw soon.
  bool Busy() const { return playback_.playing() || preview_.busy(); }

  // Updates all parts. Call once for each frame of the interface. seconds: since the last call.
  void Update(double seconds);

 private:
  Workspace(std::unique_ptr<MessageLog> messages,
            std::unique_ptr<ProjectSession> project,
            Log& log);

  // Orders pictures of the cast and the objects.
  void OrderPictures();
  // Whether the camera view shows a picture, or none is expected.
  bool ShowsPreview() const;

  std::unique_ptr<MessageLog> messages_;
  std::unique_ptr<ProjectSession> project_;
  // Locked while people are baked, so that no person is baked twice at the same time.
  std::shared_ptr<std::mutex> baking_ = std::make_shared<std::mutex>();
  MapSession map_;
  MapTraining training_;
  CastSession cast_;
  ProbePictures probe_pictures_;
  ProductNotes product_notes_;
  DryRunSession dry_run_;
  Playback playback_;
  PreviewSession preview_;
  JobRunner jobs_;
  double since_files_checked_ = 0.0;  // Seconds.
  // All people are baked, so that their pictures can wait for the preview's first picture.
  bool people_wait_ = false;
  // The last member: its threads must end before the other members are destroyed.
  TaskList tasks_;
};

}  // namespace lararium::editor
