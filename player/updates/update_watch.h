#pragma once

// Tells a running show that a newer one was fetched. Looks at the disk on a thread of its own,
// because disks are slow.

#include <atomic>
#include <cstdint>
#include <thread>

#include "player/updates/update_store.h"
#include "shared/core/log.h"

namespace lararium::player {

class UpdateWatch {
 public:
  // serial: of the show that runs.
  UpdateWatch(const UpdateStore& store, uint64_t serial, Log& log);

  // Call this when a picture was shown. Ten seconds after the first one, the show is marked as
  // good.
  void Shown() { shown_ = true; }
  // Whether there is a show that is newer than the one that runs.
  bool ready() const { return ready_; }

 private:
  std::atomic<bool> shown_ = false;
  std::atomic<bool> ready_ = false;
  std::jthread thread_;
};

}  // namespace lararium::player
