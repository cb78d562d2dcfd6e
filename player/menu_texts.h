#pragma once

// What the visitor's menu says, in the languages that the program knows.

#include <string>
#include <string_view>

#include "shared/render/caption_font.h"

namespace lararium::player {

struct MenuTexts {
  std::string louder;
  std::string quieter;
  std::string language;  // before the language's name
  std::string captions;  // likewise
  std::string off;       // there are no captions
  std::string restart;
  std::string find_anew;
  std::string close;
};

// English for languages that the program does not know, and where a font lacks letters.
// language: as "la", "en-GB"; what follows a hyphen does not count.
MenuTexts TextsOfMenu(std::string_view language, const render::CaptionFont& font);

// What a language calls itself, as far as the font can write it; its code otherwise.
std::string NameOfLanguage(const std::string& language, const render::CaptionFont& font);

}  // namespace lararium::player
