#pragma once

#include <span>
#include <string_view>

namespace lararium::drama {

// A file of lua/std, embedded when the library is built.
struct StdScript {
  const char* name;
  std::string_view text;
};

// In the order in which they are loaded before every drama.
std::span<const StdScript> StdScripts();

}  // namespace lararium::drama
