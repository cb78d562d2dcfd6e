#pragma once

#include <string_view>

#include "shared/core/status.h"

namespace lararium::train {

// What the errors of a training name as their place.
inline constexpr std::string_view kTraining = "training";

inline Status CancelledStatus() { return Status::Error(kTraining, "cancelled"); }

}  // namespace lararium::train
