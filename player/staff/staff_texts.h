#pragma once

// The embedded files of the staff page, and its texts in all languages.

#include <span>
#include <string>
#include <string_view>

#include "shared/core/embedded_text.h"

namespace lararium::player {

// The files page.html, page.css, page.js, parts.js and words.json.
std::span<const EmbeddedText> StaffPageFiles();

// The language of the page that a browser prefers according to its header Accept-Language; English
// if the page has none of its languages.
std::string_view StaffLanguage(std::string_view accept_language);

// page.html with each {{word}} replaced: texts by their names, "language", and "words", which
// stands for all texts as JSON that is safe inside HTML.
std::string StaffPageIn(std::string_view language);

}  // namespace lararium::player
