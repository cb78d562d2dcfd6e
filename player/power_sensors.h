#pragma once

// Heat and battery, from where Linux keeps them.

#include <filesystem>
#include <functional>
#include <optional>
#include <stop_token>
#include <thread>

#include "shared/core/mailbox.h"
#include "shared/show/quality_controller.h"

namespace lararium::player {

// sys: usually /sys. What is not there, or is no number, is not known.
show::PowerState ReadPower(const std::filesystem::path& sys = "/sys");

struct Battery {
  double share = 0.0;  // that is left, 0..1
  bool charging = false;
};
// The emptiest battery of the machine, whether it is used or charged; none: there is none, or it
// is not known.
std::optional<Battery> ReadBattery(const std::filesystem::path& sys = "/sys");

// Reads heat and battery now and then on a thread of its own: drivers of sensors take their time.
class PowerWatch {
 public:
  using Read = std::function<show::PowerState()>;

  explicit PowerWatch(
      double seconds_between, Read read = [] { return ReadPower(); });

  // What was read since it was last asked, if anything was. Does not wait.
  std::optional<show::PowerState> Take() { return power_.TryTake(); }

 private:
  void Watch(double seconds_between, const Read& read, const std::stop_token& stop);

  Mailbox<show::PowerState> power_;
  std::jthread thread_;
};

}  // namespace lararium::player
