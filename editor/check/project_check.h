#pragma once

// Checks a saved project, for the subcommand check and the Checks panel of the window.

#include <vector>

#include "editor/check/dry_run.h"
#include "editor/text/command_result.h"
#include "shared/core/progress.h"
#include "shared/core/sentence.h"
#include "shared/core/status.h"

namespace lararium::editor {

struct CheckedProject {
  CommandResult result;  // Contains the same texts in English.
  std::vector<Sentence> problems;
  std::vector<Sentence> warnings;  // Not errors, but perhaps not intended.
};
Result<CheckedProject> CheckProject(const CheckOptions& options, Progress& progress);

}  // namespace lararium::editor
