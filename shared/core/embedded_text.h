#pragma once

#include <string_view>

namespace lararium {

// A file whose text was built into the program (cmake/targets.cmake,
// lararium_embed): programs need none of ours beside them.
struct EmbeddedText {
  std::string_view name;  // of the file, without its folder
  std::string_view text;
};

}  // namespace lararium
