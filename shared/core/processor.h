#pragma once

#include "shared/core/status.h"

namespace lararium {

// Checks that this processor has the instructions that the build needs. Call it first in main():
// otherwise the program would crash with an illegal instruction.
Status CheckProcessor();

}  // namespace lararium
