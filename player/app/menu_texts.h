#pragma once

// The texts of the visitor's menu in all languages of the program (show/visitor_texts.json).

#include <array>
#include <string>
#include <string_view>

#include "shared/render/text/caption_font.h"

namespace lararium::player {

// The texts live as long as the program. The menu shows the current choice behind the name of an
// item, after a colon.
struct MenuTexts {
  std::string louder;
  std::string quieter;
  std::string language;  // followed by the name of the spoken language
  std::string captions;  // followed by the name of the captions' language, or by `off`
  std::string off;
  std::string caption_size;
  std::array<std::string, 3> sizes;  // index: render::CaptionSize
  std::string contrast;
  std::array<std::string, 2> contrasts;  // index: render::CaptionContrast
  std::string descriptions;
  std::array<std::string, 2> switches;  // descriptions off, on
  std::string motion;
  std::array<std::string, 2> motions;  // full motion, reduced motion
  std::string restart;
  std::string find_anew;
  std::string close;
};

// Returns English if the program does not know a language or the font lacks letters for it.
// language: a tag such as "la" or "en-GB"; the part after a hyphen is ignored.
const MenuTexts& TextsOfMenu(std::string_view language, const render::CaptionFont& font);

// The name of a language in that language; its code if the font lacks letters for the name.
std::string NameOfLanguage(const std::string& language, const render::CaptionFont& font);

}  // namespace lararium::player
