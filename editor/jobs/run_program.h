#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "shared/core/progress.h"
#include "shared/core/status.h"

namespace lararium::editor {

// What the user can do where a program cannot be started, and where it ends with an error.
struct ProgramRemedies {
  std::string missing;
  std::string failed;
};

// Called with each line of a program's output.
using SaysLine = std::function<void(const std::string& line)>;

// Runs a program (a file or a name in PATH) until it ends. Cancelling asks it, and the programs
// that it started, to end. Fails where it cannot be run or ends with an error; the message has the
// last line of its output.
Status RunProgram(const std::filesystem::path& program,
                  const std::vector<std::string>& arguments,
                  const ProgramRemedies& remedies,
                  Progress& progress,
                  const SaysLine& says = {});

}  // namespace lararium::editor
