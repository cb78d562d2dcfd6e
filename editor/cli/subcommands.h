#pragma once

// The steps of authoring without the window. Each returns a report as text and as JSON.

#include "editor/cli/options.h"
#include "editor/text/command_result.h"
#include "shared/core/log.h"
#include "shared/core/progress.h"
#include "shared/core/status.h"

namespace lararium::editor {

Result<CommandResult> RunNew(const NewOptions& options);
Result<CommandResult> RunTrain(const TrainCommandOptions& options, Progress& progress, Log& log);
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
Result<CommandResult> RunPublish(const PublishOptions& options, Progress& progress);
Result<CommandResult> RunKey(const KeyOptions& options);
Result<CommandResult> RunFetchCastLibrary(Progress& progress);

}  // namespace lararium::editor
