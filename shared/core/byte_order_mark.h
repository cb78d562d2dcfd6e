#pragma once

#include <string_view>

namespace lararium {

// The text behind the byte order mark that some programs put before UTF-8.
inline std::string_view WithoutByteOrderMark(std::string_view text) {
  return text.starts_with("\xEF\xBB\xBF") ? text.substr(3) : text;
}

}  // namespace lararium
