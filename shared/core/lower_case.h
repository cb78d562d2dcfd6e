#pragma once

#include <string>
#include <string_view>

namespace lararium {

// A to Z as a to z, and all else as it is, in every locale: for names of files, hosts and formats,
// and for words within a sentence.
std::string LowerCase(std::string_view text);

}  // namespace lararium
