#pragma once

#include <string>

#include "editor/jobs/background_task.h"

namespace lararium::editor {

// The current step of a task, its number and the remaining time, as far as they are known, in the
// language of the interface: "Training: matching (3 of 7), 20 s left".
std::string TaskText(TaskKind kind, const BackgroundTask::State& state);

}  // namespace lararium::editor
