#pragma once

#include <string>
#include <string_view>

namespace lararium {

// Escapes text for HTML and for attributes in quotes. Control characters become blanks.
std::string EscapeHtml(std::string_view text);

}  // namespace lararium
