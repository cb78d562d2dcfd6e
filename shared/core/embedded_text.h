#pragma once

#include <string_view>

namespace lararium {

// A file whose text is compiled into the program (cmake/targets.cmake, lararium_embed), so that
// programs need no data files beside them.
struct EmbeddedText {
  std::string_view name;  // file name without its folder
  std::string_view text;
};

}  // namespace lararium
