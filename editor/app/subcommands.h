#pragma once

// The steps of authoring without the window. Each returns what it did, as text
// and as JSON.

#include <string>

#include "editor/app/options.h"
#include "editor/app/project.h"
#include "shared/core/json.h"
#include "shared/core/log.h"
#include "shared/core/progress.h"
#include "shared/core/status.h"
#include "shared/show/show_content.h"
#include "shared/stage/stage.h"

namespace lararium::app {

struct CommandResult {
  std::string text;  // for people, lines
  Json json = Json::object();
  bool failed = false;  // the work was done, and its result is bad (check found problems)
};

// The stage with everybody and everything on it, as a show spoken in a language has it; ""
// is its first. content: gets its lines.
Status FillStage(const ProjectPaths& paths,
                 const ProjectDocument& document,
                 const std::string& spoken,
                 stage::Stage& stage,
                 show::ShowContent& content);

// The place that an option names, or the only one.
Result<std::string> ChoosePlace(const ProjectPaths& paths,
                                const ProjectDocument& document,
                                const std::string& name);

Result<CommandResult> RunNew(const NewOptions& options);
Result<CommandResult> RunTrain(const TrainOptions& options, Progress& progress, Log& log);
Result<CommandResult> RunImportColmap(const ImportColmapOptions& options,
                                      Progress& progress,
                                      Log& log);
Result<CommandResult> RunExportColmap(const ExportColmapOptions& options);
Result<CommandResult> RunMeasure(const MeasureOptions& options);
Result<CommandResult> RunPrune(const PruneOptions& options, Progress& progress);
Result<CommandResult> RunBake(const BakeOptions& options, Progress& progress);
Result<CommandResult> RunCheck(const CheckOptions& options, Progress& progress);
Result<CommandResult> RunCredits(const CreditsOptions& options);
Result<CommandResult> RunRender(const RenderOptions& options, Progress& progress, Log& log);
Result<CommandResult> RunExport(const ExportOptions& options, Progress& progress);
Result<CommandResult> RunKey(const KeyOptions& options);

}  // namespace lararium::app
