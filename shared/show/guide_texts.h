#pragma once

// What a visitor who has lost the place, or whose visit is over, is told, in the languages that
// the program knows. An author says it better, by the lines "guide_PLACE", "guide" or "farewell"
// of the show.

#include <string>
#include <string_view>

#include "shared/render/caption_font.h"

namespace lararium::show {

struct GuideTexts {
  std::string look;  // beside a picture of where to look
  std::string dark;  // the camera sees nothing
  std::string farewell;
};

// English for languages that the program does not know, and where a font lacks letters.
// language: as "la", "en-GB"; what follows a hyphen does not count.
GuideTexts BuiltInGuide(std::string_view language, const render::CaptionFont& font);

// Whether a font has all letters of a text.
bool CanWrite(const render::CaptionFont& font, std::string_view text);

}  // namespace lararium::show
