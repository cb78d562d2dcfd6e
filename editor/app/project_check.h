#pragma once

// What is wrong with a project as it is saved: the subcommand check and the window's Checks.

#include <vector>

#include "editor/app/options.h"
#include "editor/app/subcommands.h"
#include "shared/core/progress.h"
#include "shared/core/sentence.h"
#include "shared/core/status.h"

namespace lararium::app {

struct CheckedProject {
  CommandResult result;  // with the same in English
  std::vector<Sentence> problems;
  std::vector<Sentence> warnings;  // what is right, but perhaps not meant
};
Result<CheckedProject> CheckProject(const CheckOptions& options, Progress& progress);

}  // namespace lararium::app
