#pragma once

#include <cstdlib>

namespace lararium::test {

// Returns true where tests may take minutes: those with the label slow (lararium_thorough_test in
// cmake/targets.cmake).
inline bool IsThorough() { return std::getenv("LARARIUM_THOROUGH") != nullptr; }

}  // namespace lararium::test
