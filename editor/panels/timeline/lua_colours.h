#pragma once

// Syntax colouring of Lua.

#include <cstdint>
#include <string_view>
#include <vector>

namespace lararium::panels {

enum class LuaPart : uint8_t { kPlain, kKeyword, kText, kNumber, kComment, kCall, kBad };

struct ColouredWord {
  uint32_t begin = 0;  // Bytes.
  uint32_t end = 0;
  LuaPart part = LuaPart::kPlain;
};

// In the order of the text; everything in between is plain. A string that is not closed is bad from
// its beginning.
std::vector<ColouredWord> ColourLua(std::string_view text);

// The position of each line's beginning; at least one entry.
std::vector<size_t> LineStarts(std::string_view text);

}  // namespace lararium::panels
