#pragma once

// The files of the staff page, built into the program, and its words in the languages that it has.

#include <span>
#include <string>
#include <string_view>

#include "shared/core/embedded_text.h"

namespace lararium::player {

// page.html, page.css, page.js.
std::span<const EmbeddedText> StaffPageFiles();

// Of the page's languages the one that a browser likes best, by its header Accept-Language;
// English where it likes none of them.
std::string_view StaffLanguage(std::string_view accept_language);

// page.html with {{word}} in place: its words, "language", and "words", all of them as JSON that
// may stand within HTML.
std::string StaffPageIn(std::string_view language);

}  // namespace lararium::player
