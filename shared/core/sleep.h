#pragma once

#include <chrono>
#include <stop_token>

namespace lararium {

// Sleeps until `due`, or until a stop is requested.
void SleepUntil(std::chrono::steady_clock::time_point due, const std::stop_token& stop);

}  // namespace lararium
