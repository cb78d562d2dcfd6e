#pragma once

// Jobs on the whole project that the user starts: baking, checking, exporting, trying the exported
// show, measuring a camera. Keeps their newest results; messages tell the rest. Use it from the
// interface thread only.

#include <filesystem>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "editor/check/project_check.h"
#include "editor/jobs/background_task.h"
#include "editor/jobs/bundle_summary.h"
#include "editor/jobs/exporting.h"
#include "editor/session/message_log.h"
#include "editor/session/preview_session.h"
#include "editor/session/project_session.h"
#include "shared/core/sentence.h"

namespace lararium::editor {

class JobRunner {
 public:
  // baking: locked while the project is baked. The other arguments must outlive the runner.
  JobRunner(ProjectSession& project,
            PreviewSession& preview,
            TaskList& tasks,
            MessageLog& messages,
            std::shared_ptr<std::mutex> baking);

  void Bake();

  // Checks the saved project, like the subcommand check.
  void Check();
  bool checked() const { return checked_; }
  const std::vector<Sentence>& problems() const { return findings_.problems; }
  // Findings of the check that are valid but possibly not intended.
  const std::vector<Sentence>& warnings() const { return findings_.warnings; }

  // Saves the project first.
  void Export(const ExportRequest& request);
  struct ExportedShow {
    std::filesystem::path file;
    BundleSummary contents;
  };
  // The last export of this window; nullptr before the first.
  const ExportedShow* exported() const { return exported_.get(); }
  // Why the last export failed; empty where it did not.
  const std::string& export_problem() const { return export_problem_; }
  // Opens the exported show in the player, at the current place.
  void TryShow();

  // Measures noise and sharpness of the current place's images from its training recording. The
  // result is an edit.
  void MeasureCameraTraits();

 private:
  ProjectSession& project_;
  PreviewSession& preview_;
  TaskList& tasks_;
  MessageLog& messages_;
  std::shared_ptr<std::mutex> baking_;
  bool checked_ = false;
  CheckedProject findings_;
  std::shared_ptr<const ExportedShow> exported_;
  std::string export_problem_;
};

}  // namespace lararium::editor
