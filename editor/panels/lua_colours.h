#pragma once

// Which part of a Lua text is what, for colouring it.

#include <cstdint>
#include <string_view>
#include <vector>

namespace lararium::panels {

enum class LuaPart : uint8_t { kPlain, kKeyword, kText, kNumber, kComment, kCall, kBad };

struct ColouredWord {
  uint32_t begin = 0;  // bytes
  uint32_t end = 0;
  LuaPart part = LuaPart::kPlain;
};

// In the order of the text; what lies between them is plain. A text that never ends is bad
// from where it begins.
std::vector<ColouredWord> ColourLua(std::string_view text);

// Where each line begins; at least one.
std::vector<size_t> LineStarts(std::string_view text);

}  // namespace lararium::panels
