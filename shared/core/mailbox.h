#pragma once

// A single-slot mailbox between two threads in which the newest message wins: messages for a slow
// reader are dropped, never queued.

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <optional>
#include <stop_token>
#include <utility>

namespace lararium {

template <typename T>
class Mailbox {
 public:
  // Replaces a message that was not taken yet, and returns it so that its buffers can be reused.
  std::optional<T> Put(T message) {
    std::optional<T> replaced(std::move(message));
    {
      const std::lock_guard lock(mutex_);
      dropped_ += slot_.has_value() ? 1 : 0;
      std::swap(slot_, replaced);
    }
    filled_.notify_one();
    return replaced;
  }

  // Closes the mailbox: no message will follow. Take() still returns the last one, then nullopt.
  void Close() {
    {
      const std::lock_guard lock(mutex_);
      closed_ = true;
    }
    filled_.notify_all();
  }

  // Waits for a message. Returns nullopt if the mailbox is closed and empty, or if a stop was
  // requested.
  std::optional<T> Take(std::stop_token stop) {
    std::unique_lock lock(mutex_);
    filled_.wait(lock, stop, [this] { return slot_.has_value() || closed_; });
    if (stop.stop_requested()) {
      return std::nullopt;
    }
    return std::exchange(slot_, std::nullopt);
  }

  // Same as Take(), but waits no longer than `timeout`.
  std::optional<T> TakeFor(std::chrono::milliseconds timeout) {
    std::unique_lock lock(mutex_);
    filled_.wait_for(lock, timeout, [this] { return slot_.has_value() || closed_; });
    return std::exchange(slot_, std::nullopt);
  }

  // Returns the newest message, if there is one, without waiting.
  std::optional<T> TryTake() {
    const std::lock_guard lock(mutex_);
    return std::exchange(slot_, std::nullopt);
  }

  // True if the mailbox is closed and empty: no message will follow.
  bool Finished() const {
    const std::lock_guard lock(mutex_);
    return closed_ && !slot_.has_value();
  }

  // Number of messages that were replaced before they were taken.
  uint64_t dropped() const {
    const std::lock_guard lock(mutex_);
    return dropped_;
  }

 private:
  mutable std::mutex mutex_;
  std::condition_variable_any filled_;
  std::optional<T> slot_;
  bool closed_ = false;
  uint64_t dropped_ = 0;
};

}  // namespace lararium
