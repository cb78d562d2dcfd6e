#pragma once

// Logging goes through spdlog; the logger is an argument, never a global.

#include <spdlog/logger.h>

#include <filesystem>
#include <memory>

#include "shared/core/status.h"

namespace lararium {

using Log = spdlog::logger;

// Writes to stderr, and to a file as well when one is named.
Result<std::shared_ptr<Log>> MakeLog(const std::filesystem::path& file = {});

// For tests and tools that want silence.
std::shared_ptr<Log> MakeSilentLog();

}  // namespace lararium
