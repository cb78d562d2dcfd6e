#pragma once

// The steps of authoring without the window. Each returns what it did, as text
// and as JSON.

#include <string>

#include "editor/app/options.h"
#include "shared/core/json.h"
#include "shared/core/log.h"
#include "shared/core/progress.h"
#include "shared/core/status.h"

namespace lararium::app {

struct CommandResult {
  std::string text;  // for people, lines
  Json json = Json::object();
  bool failed = false;  // the work was done, and its result is bad (check found problems)
};

Result<CommandResult> RunNew(const NewOptions& options);
Result<CommandResult> RunTrain(const TrainOptions& options, Progress& progress, Log& log);
Result<CommandResult> RunCast(const CastOptions& options);
Result<CommandResult> RunBake(const BakeOptions& options, Progress& progress);
Result<CommandResult> RunCheck(const CheckOptions& options, Progress& progress);
Result<CommandResult> RunRender(const RenderOptions& options, Progress& progress, Log& log);
Result<CommandResult> RunExport(const ExportOptions& options, Progress& progress);

}  // namespace lararium::app
