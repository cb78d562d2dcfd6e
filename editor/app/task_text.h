#pragma once

#include <string>

#include "editor/app/background_task.h"

namespace lararium::app {

// What a task does at the moment and how long its step still takes, as far as that can be told, in
// the language of the interface: "Exporting: packing, 20 s left". name: of the task.
std::string TaskText(const std::string& name, const BackgroundTask::State& state);

}  // namespace lararium::app
