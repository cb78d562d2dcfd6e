#pragma once

// What the visitor's menu says, in the languages that the program knows.

#include <array>
#include <string>
#include <string_view>

#include "shared/render/caption_font.h"

namespace lararium::player {

// They live as long as the program. What is chosen stands behind a name, after a colon.
struct MenuTexts {
  std::string_view louder;
  std::string_view quieter;
  std::string_view language;  // before the language's name
  std::string_view captions;  // likewise
  std::string_view off;       // there are no captions
  std::string_view caption_size;
  std::array<std::string_view, 3> sizes;  // by render::CaptionSize
  std::string_view contrast;
  std::array<std::string_view, 2> contrasts;  // by render::CaptionContrast
  std::string_view descriptions;
  std::array<std::string_view, 2> switches;  // they are not heard, and are
  std::string_view motion;
  std::array<std::string_view, 2> motions;  // all of it, reduced
  std::string_view restart;
  std::string_view find_anew;
  std::string_view close;
};

// English for languages that the program does not know, and where a font lacks letters.
// language: as "la", "en-GB"; what follows a hyphen does not count.
const MenuTexts& TextsOfMenu(std::string_view language, const render::CaptionFont& font);

// What a language calls itself, as far as the font can write it; its code otherwise.
std::string NameOfLanguage(const std::string& language, const render::CaptionFont& font);

}  // namespace lararium::player
