#pragma once

// Logging with spdlog. The logger is passed as an argument and is never a global.

#include <spdlog/logger.h>

#include <filesystem>
#include <memory>

#include "shared/core/status.h"

namespace lararium {

using Log = spdlog::logger;

// Creates a log to stderr and, if `file` is not empty, to that file.
Result<std::shared_ptr<Log>> MakeLog(const std::filesystem::path& file = {});

// For tests and tools without output.
std::shared_ptr<Log> MakeSilentLog();

}  // namespace lararium
