#include "shared/core/background.h"

namespace lararium {

std::launch BackgroundLaunch() { return std::launch::async; }

}  // namespace lararium
