#pragma once

#include <cstdlib>

namespace lararium::test {

// Whether tests may take minutes: those with the label slow (lararium_thorough_test in
// cmake/targets.cmake).
inline bool IsThorough() { return std::getenv("LARARIUM_THOROUGH") != nullptr; }

}  // namespace lararium::test
