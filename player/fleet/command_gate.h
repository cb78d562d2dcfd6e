#pragma once

// Decides which messages of a broker reach the player.

#include <chrono>
#include <cstdint>
#include <string_view>

#include "shared/core/status.h"

namespace lararium::player {

class CommandGate {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr int kMostInASecond = 16;
  static constexpr int64_t kRefusedToAWarning = 100;

  // An error if a message must not be passed on: it is no command (ParseStaffCommand) or too long;
  // the broker has kept it, so that it was meant for an earlier moment; or there were too many in
  // the last second. kept: the message is a retained one.
  Status Check(std::string_view payload, bool kept, Clock::time_point now);

  // True for the first refused message and each hundredth after it, for which the log has a line.
  bool tells() const { return refused_ % kRefusedToAWarning == 1; }
  int64_t refused() const { return refused_; }

 private:
  Status Judge(std::string_view payload, bool kept, Clock::time_point now);

  Clock::time_point second_began_;
  int in_second_ = 0;
  int64_t refused_ = 0;
};

}  // namespace lararium::player
