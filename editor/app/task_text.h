#pragma once

#include <string>

#include "editor/app/background_task.h"

namespace lararium::app {

// What a task does at the moment, which of its steps that is and how long it still takes, as far as
// that can be told, in the language of the interface: "Training: matching (3 of 7), 20 s left".
// name: of the task.
std::string TaskText(const std::string& name, const BackgroundTask::State& state);

}  // namespace lararium::app
