#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace lararium {

// Returns the character at byte `at` and moves `at` behind it. Invalid UTF-8 gives U+FFFD.
uint32_t NextCharacter(std::string_view text, size_t& at);

// Appends a Unicode scalar value as UTF-8.
void AppendCharacter(uint32_t character, std::string& text);

// Whether the whole text is valid UTF-8.
bool IsUtf8(std::string_view text);

}  // namespace lararium
