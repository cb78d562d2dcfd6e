#pragma once

#include <string>
#include <string_view>

namespace lararium {

// Converts A to Z to lower case and leaves all other characters unchanged, in every locale. For
// names of files, hosts and formats, and for words within a sentence.
std::string LowerCase(std::string_view text);

}  // namespace lararium
