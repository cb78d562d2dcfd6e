#pragma once

// Text files as other programs write them: with a byte order mark, in UTF-16, with any line ends.

#include <optional>
#include <string>
#include <string_view>

namespace lararium {

// The text behind the byte order mark that some programs put before UTF-8.
inline std::string_view WithoutByteOrderMark(std::string_view text) {
  return text.starts_with("\xEF\xBB\xBF") ? text.substr(3) : text;
}

// Whether the bytes begin as UTF-16 does: with a byte order mark, or with an ASCII character.
bool LooksLikeUtf16(std::string_view bytes);

// nullopt if a surrogate has no partner.
std::optional<std::string> Utf8FromUtf16(std::u16string_view text);

// Writes "\r\n" and '\r' as '\n'.
std::string WithUnixLineEnds(std::string text);

// Converts UTF-16 (LooksLikeUtf16) to UTF-8, removes byte
// order marks and writes every line end as '\n'. Bytes in another encoding stay unchanged;
// IsUtf8() tells.
std::string PlainText(std::string bytes);

}  // namespace lararium
