#pragma once

// Heat and battery, from where Linux keeps them.

#include <filesystem>

#include "shared/show/quality_controller.h"

namespace lararium::player {

// sys: usually /sys. What is not there, or is no number, is not known.
show::PowerState ReadPower(const std::filesystem::path& sys = "/sys");

}  // namespace lararium::player
