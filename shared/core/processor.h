#pragma once

#include "shared/core/status.h"

namespace lararium {

// Whether this processor has the instructions the build was made for. Called
// first in main(): without it a program would die of an illegal instruction.
Status CheckProcessor();

}  // namespace lararium
