#pragma once

// Heat and battery, from where Linux keeps them.

#include <filesystem>
#include <optional>

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

}  // namespace lararium::player
