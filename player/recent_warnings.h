#pragma once

// The last warnings and errors of a log, for staff who do not read it.

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
  static constexpr size_t kMostBytes = 240;  // of a text; what is longer is cut

  struct Entry {
    std::string text;  // its first line
    bool error = false;
    std::chrono::steady_clock::time_point time;  // when it was last said
    int times = 1;                               // that it was said in a row
  };

  // Oldest first. From any thread.
  std::vector<Entry> Entries();

  // Hears of all that a log is told from now on; the same for the same log. Not while others write
  // to it.
  static std::shared_ptr<RecentWarnings> Of(Log& log);

 protected:
  void sink_it_(const spdlog::details::log_msg& message) override;
  void flush_() override {}

 private:
  std::deque<Entry> entries_;
};

}  // namespace lararium::player
