#pragma once

// Keeps the last warnings and errors of a log, for the staff page.

#include <spdlog/sinks/base_sink.h>

#include <chrono>
#include <cstddef>
#include <deque>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "shared/core/log.h"

namespace lararium::player {

class RecentWarnings : public spdlog::sinks::base_sink<std::mutex> {
 public:
  static constexpr size_t kMostEntries = 12;
  static constexpr size_t kMostBytes = 240;  // longer texts are cut

  struct Entry {
    std::string text;  // first line of the message
    bool error = false;
    std::chrono::steady_clock::time_point time;  // time of the last repetition
    int times = 1;                               // number of repetitions in a row
  };

  // Returns the entries, oldest first. May be called from any thread.
  std::vector<Entry> Entries();

  // Returns the collector of a log, which is created by the first call and then receives all
  // messages. Do not call it while other threads write to the log.
  static std::shared_ptr<RecentWarnings> Of(Log& log);

 protected:
  void sink_it_(const spdlog::details::log_msg& message) override;
  void flush_() override {}

 private:
  std::deque<Entry> entries_;
};

}  // namespace lararium::player
