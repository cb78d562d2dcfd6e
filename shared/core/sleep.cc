#include "shared/core/sleep.h"

#include <condition_variable>
#include <mutex>

namespace lararium {

void SleepUntil(std::chrono::steady_clock::time_point due, const std::stop_token& stop) {
  std::mutex mutex;
  std::unique_lock lock(mutex);
  std::condition_variable_any never;
  never.wait_until(lock, stop, due, [] { return false; });
}

}  // namespace lararium
