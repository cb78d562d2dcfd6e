#include "player/updates/update_watch.h"

#include <chrono>
#include <condition_variable>
#include <mutex>

namespace lararium::player {
namespace {

constexpr std::chrono::seconds kInterval(1);
constexpr int kIntervalsToBeGood = 10;

}  // namespace

UpdateWatch::UpdateWatch(const UpdateStore& store, uint64_t serial, Log& log) {
  thread_ = std::jthread([this, store, serial, &log](const std::stop_token& stop) {
    std::mutex mutex;
    std::condition_variable_any ended;
    std::unique_lock lock(mutex);
    int intervals = 0;
    while (!ended.wait_for(lock, stop, kInterval, [&] { return stop.stop_requested(); })) {
      intervals += shown_ ? 1 : 0;
      const Status marked = intervals == kIntervalsToBeGood ? store.MarkGood(serial) : Status();
      if (!marked.ok()) {
        log.Warn("update: {}", marked.message());
      }
      ready_ = store.Newest().serial > serial;
    }
  });
}

}  // namespace lararium::player
