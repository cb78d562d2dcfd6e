#include "editor/session/job_runner.h"

#include <utility>

#include "editor/jobs/baking.h"
#include "editor/jobs/camera_measure.h"
#include "editor/session/player_trial.h"
#include "editor/text/text.h"

namespace lararium::editor {

JobRunner::JobRunner(ProjectSession& project,
                     PreviewSession& preview,
                     TaskList& tasks,
                     MessageLog& messages,
                     std::shared_ptr<std::mutex> baking)
    : project_(project),
      preview_(preview),
      tasks_(tasks),
      messages_(messages),
      baking_(std::move(baking)) {}

void JobRunner::Bake() {
  const auto report = std::make_shared<BakeReport>();
  tasks_.Start(
      TaskKind::kBaking,
      [report, paths = project_.paths(), document = project_.commands().snapshot(),
       baking = baking_](Progress& progress) {
        const std::lock_guard turn(*baking);
        LARARIUM_ASSIGN_OR_RETURN(*report, editor::Bake(paths, *document, progress));
        return Status();
      },
      [this, report](const Status& status, bool cancelled) {
        for (const std::string& warning : report->warnings) {
          messages_.Warn(warning);
        }
        messages_.Report(
            status, cancelled,
            Text(Tr("Baked %d, %d were up to date."), static_cast<int>(report->baked.size()),
                 static_cast<int>(report->unchanged.size())));
        preview_.Reopen();
      });
}

void JobRunner::Check() {
  const auto result = std::make_shared<CheckedProject>();
  tasks_.Start(
      TaskKind::kChecking,
      [result, project = project_.paths().folder](Progress& progress) {
        CheckOptions options;
        options.project = project;
        LARARIUM_ASSIGN_OR_RETURN(*result, CheckProject(options, progress));
        return Status();
      },
      [this, result](const Status& status, bool cancelled) {
        if (cancelled) {
          return;
        }
        checked_ = true;
        findings_ = std::move(*result);
        if (!status.ok()) {
          findings_.problems = {status.message()};
        }
      });
}

void JobRunner::Export(const ExportRequest& request) {
  project_.Save();  // The drama is packed from its file.
  if (project_.files().changed_outside() || project_.commands().dirty()) {
    export_problem_ = messages_.entries().back().text;
    return;
  }
  const auto shown = std::make_shared<ExportedShow>();
  shown->file = request.out;
  export_problem_.clear();
  tasks_.Start(
      TaskKind::kExporting,
      [paths = project_.paths(), document = project_.commands().snapshot(), request, shown,
       baking = baking_](Progress& progress) -> Status {
        const std::lock_guard turn(*baking);
        LARARIUM_RETURN_IF_ERROR(ExportProject(paths, *document, request, progress));
        LARARIUM_ASSIGN_OR_RETURN(shown->contents, ReadBundleSummary(request.out));
        return Status();
      },
      [this, shown](const Status& status, bool cancelled) {
        messages_.Report(status, cancelled, Text(Tr("Wrote %s"), shown->file.c_str()));
        if (status.ok() && !cancelled) {
          exported_ = shown;
        } else {
          export_problem_ =
              cancelled ? std::string(Tr("The export was cancelled.")) : status.message();
        }
      });
}

void JobRunner::TryShow() {
  if (exported_ == nullptr || project_.place() == nullptr) {
    return;
  }
  tasks_.Start(
      TaskKind::kTrying,
      [arguments = TrialArguments(project_.paths(), *project_.place(), exported_->file)](
          Progress& progress) { return RunPlayer(arguments, progress); },
      [this](const Status& status, bool cancelled) {
        if (!cancelled) {
          messages_.TellFailure(status);
        }
      });
}

void JobRunner::MeasureCameraTraits() {
  if (project_.place() == nullptr) {
    return;
  }
  const auto traits = std::make_shared<light::CameraTraits>();
  tasks_.Start(
      TaskKind::kCamera,
      [traits, paths = project_.paths(), place = *project_.place()](Progress& progress) {
        LARARIUM_ASSIGN_OR_RETURN(*traits, MeasureCamera(paths, place, progress));
        return Status();
      },
      [this, traits, name = project_.place_name()](const Status& status, bool cancelled) {
        messages_.Report(status, cancelled, name + ": " + CameraText(*traits));
        if (status.ok() && !cancelled) {
          project_.Edit(Sentence("measure the camera"), [&](ProjectDocument& document) {
            if (PlaceDocument* place = document.FindPlace(name)) {
              place->camera = *traits;
            }
          });
        }
      });
}

}  // namespace lararium::editor
