#pragma once

// A single-slot mailbox between two threads in which the newest message wins: a
// slow reader drops messages, it never queues them.

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
  // Replaces a message that was not taken yet, and gives that back: its buffers may serve again.
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

  // No message will follow. Take() still hands out the last one, then nullopt.
  void Close() {
    {
      const std::lock_guard lock(mutex_);
      closed_ = true;
    }
    filled_.notify_all();
  }

  // Waits for a message; nullopt when closed and empty, or when stop was asked.
  std::optional<T> Take(std::stop_token stop) {
    std::unique_lock lock(mutex_);
    filled_.wait(lock, stop, [this] { return slot_.has_value() || closed_; });
    if (stop.stop_requested()) {
      return std::nullopt;
    }
    return std::exchange(slot_, std::nullopt);
  }

  // The same, waiting no longer than timeout.
  std::optional<T> TakeFor(std::chrono::milliseconds timeout) {
    std::unique_lock lock(mutex_);
    filled_.wait_for(lock, timeout, [this] { return slot_.has_value() || closed_; });
    return std::exchange(slot_, std::nullopt);
  }

  // The newest message, if there is one, without waiting.
  std::optional<T> TryTake() {
    const std::lock_guard lock(mutex_);
    return std::exchange(slot_, std::nullopt);
  }

  // True once closed and emptied: nothing will come any more.
  bool Finished() const {
    const std::lock_guard lock(mutex_);
    return closed_ && !slot_.has_value();
  }

  // How many messages were replaced before they were taken.
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
