#pragma once

// Work on files that may be hostile with libraries that may not stand it.

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "shared/core/status.h"

namespace lararium::import {

struct IsolationLimits {
  size_t memory_bytes = size_t{4} << 30;  // beyond what this process has; not under sanitizers
  unsigned cpu_seconds = 120;
  unsigned wall_seconds = 300;
};

// Runs work in a forked child and returns what it returns. A child that crashes, runs out
// of memory or time is an error of the place. Only the calling thread lives in the child:
// work must not start or wait for others (no TBB, no OpenCV).
Result<std::vector<std::byte>> RunInChild(
    const std::string& place,
    const std::function<Result<std::vector<std::byte>>()>& work,
    const IsolationLimits& limits = {});

}  // namespace lararium::import
