#pragma once

// The texts for visitors in all languages of the program, visitor_texts.json: `menu` has those of
// the player's and the page's menu, `guide` those of guide_texts.h, `page` the sentences of the
// page for browsers.

#include <span>

#include "shared/core/embedded_text.h"

namespace lararium::show {

std::span<const EmbeddedText> VisitorTexts();

}  // namespace lararium::show
