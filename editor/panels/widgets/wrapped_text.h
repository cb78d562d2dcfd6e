#pragma once

// Line wrapping for ImGui's text field, which cannot wrap: the text is broken into rows with
// special characters. They differ from line breaks that the user typed, and are removed again.

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <string_view>

namespace lararium::panels {

// Both are in Unicode's private use area, which cannot be typed into ImGui's fields. The font has
// them with zero width (theme.cc).
inline constexpr char32_t kRowEnd = 0xe000;
inline constexpr char32_t kRowBegin = 0xe001;

// The width, pixels, of a UTF-8 text in one row.
using TextWidth = std::function<float(std::string_view)>;

// Breaks rows after spaces where they would be too wide, and within words that are wider than a
// row. Spaces at the end of a row may exceed the width.
std::string WrapText(std::string_view text, float width, const TextWidth& width_of);

// Removes the row breaks. Where only half of a row break remains, the user deleted at the edge of a
// row and meant the character beyond it, which is removed. positions: byte positions in wrapped,
// which are converted to those in the result.
std::string UnwrapText(std::string_view wrapped, std::span<size_t> positions = {});

// Converts a byte position of the text to one in wrapped; at a row break, to the position behind
// it.
size_t PositionInWrapped(std::string_view wrapped, size_t position);

// Moves a position out of a row break, which is invisible: forwards or backwards.
size_t OutOfRowBreak(std::string_view wrapped, size_t position, bool on);

}  // namespace lararium::panels
