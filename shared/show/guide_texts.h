#pragma once

// Built-in texts for visitors whose tracking is lost or whose visit is over, in the languages that
// the program knows. Authors can replace them by the lines "guide_PLACE", "guide" or "farewell" of
// the show.

#include <string>
#include <string_view>

#include "shared/render/text/caption_font.h"

namespace lararium::show {

struct GuideTexts {
  std::string look;  // Shown beside a picture of where to look.
  std::string dark;  // Shown if the camera image is too dark.
  std::string farewell;
};

// The texts in a language; in English if the program does not know it or the font lacks a glyph.
// language: for example "la" or "en-GB"; the part after a hyphen is ignored. font: nullptr: the
// texts are not drawn with a show's font.
GuideTexts BuiltInGuide(std::string_view language, const render::CaptionFont* font);

// Whether a font has glyphs for a whole text.
bool CanWrite(const render::CaptionFont& font, std::string_view text);

}  // namespace lararium::show
