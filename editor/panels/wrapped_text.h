#pragma once

// Text for a field that cannot wrap by itself, as ImGui's cannot: broken into rows by signs of its
// own, which are told from line breaks that somebody typed and taken out again.

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <string_view>

namespace lararium::panels {

// Both lie in Unicode's private use area, which nobody can type into a field of ImGui's; the font
// has them without width (theme.cc).
inline constexpr char32_t kRowEnd = 0xe000;
inline constexpr char32_t kRowBegin = 0xe001;

// Of a text in UTF-8 in one row, pixels.
using TextWidth = std::function<float(std::string_view)>;

// Broken after spaces where rows would be wider than width, within words that are wider; spaces at
// the end of a row may stand beyond it.
std::string WrapText(std::string_view text, float width, const TextWidth& width_of);

// The text without row breaks. One that lost a part was edited there: somebody deleted backwards
// from the beginning of a row, or forwards from its end, and meant the letter beyond. positions:
// of bytes in wrapped; become those of the same places in the text.
std::string UnwrapText(std::string_view wrapped, std::span<size_t> positions = {});

// Where a byte of the text lies in wrapped; behind a row break rather than before it.
size_t PositionInWrapped(std::string_view wrapped, size_t position);

// A position within a row break, which nobody sees, moved out of it: on, or back.
size_t OutOfRowBreak(std::string_view wrapped, size_t position, bool on);

}  // namespace lararium::panels
