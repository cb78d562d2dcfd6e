#pragma once

// Runs work on possibly hostile files in a child process, because libraries may fail on them.

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "shared/core/status.h"

namespace lararium::import {

struct IsolationLimits {
  // In addition to the memory of this process; not enforced under sanitizers.
  size_t memory_bytes = size_t{4} << 30;
  unsigned cpu_seconds = 120;
  unsigned wall_seconds = 300;
};

// Runs `work` in a forked child and returns its result. A child that crashes or exceeds memory
// or time gives an error that names `where`. Only the calling thread exists in the child, so
// that `work` must not start threads or wait for others (no TBB, no OpenCV).
Result<std::vector<std::byte>> RunInChild(
    const std::string& where,
    const std::function<Result<std::vector<std::byte>>()>& work,
    const IsolationLimits& limits = {});

}  // namespace lararium::import
