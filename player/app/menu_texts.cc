#include "player/app/menu_texts.h"

#include <algorithm>
#include <functional>
#include <map>
#include <span>

#include "shared/core/check.h"
#include "shared/core/json.h"
#include "shared/show/guide_texts.h"
#include "shared/show/visitor_texts.h"

namespace lararium::player {
namespace {

struct Known {
  std::string name;
  MenuTexts texts;
};

using AllTexts = std::map<std::string, Known, std::less<>>;  // Keyed by language.

AllTexts ReadTexts() {
  const EmbeddedText& file = show::VisitorTexts().front();
  const Result<Json> json = ParseJson(file.text, file.name);
  CHECK(json.ok());
  AllTexts all;
  for (const auto& [language, texts] : json->items()) {
    Known& known = all[language];
    texts.at("name").get_to(known.name);
    const Json& menu = texts.at("menu");
    MenuTexts& m = known.texts;
    for (const auto& [name, text] : {std::pair("louder", &m.louder),
                                     {"quieter", &m.quieter},
                                     {"language", &m.language},
                                     {"captions", &m.captions},
                                     {"off", &m.off},
                                     {"caption_size", &m.caption_size},
                                     {"contrast", &m.contrast},
                                     {"descriptions", &m.descriptions},
                                     {"motion", &m.motion},
                                     {"restart", &m.restart},
                                     {"find_anew", &m.find_anew},
                                     {"close", &m.close}}) {
      menu.at(name).get_to(*text);
    }
    menu.at("sizes").get_to(m.sizes);
    menu.at("contrasts").get_to(m.contrasts);
    menu.at("switches").get_to(m.switches);
    menu.at("motions").get_to(m.motions);
  }
  return all;
}

const AllTexts& All() {
  static const AllTexts all = ReadTexts();
  return all;
}

const Known* Find(std::string_view language) {
  const auto found = All().find(language.substr(0, language.find('-')));
  return found == All().end() ? nullptr : &found->second;
}

bool CanWrite(const render::CaptionFont& font, const MenuTexts& texts) {
  const auto all_of = [&](std::span<const std::string> some) {
    return std::all_of(some.begin(), some.end(),
                       [&](std::string_view text) { return show::CanWrite(font, text); });
  };
  return all_of(std::array{texts.louder, texts.quieter, texts.language, texts.captions, texts.off,
                           texts.caption_size, texts.contrast, texts.descriptions, texts.motion,
                           texts.restart, texts.find_anew, texts.close}) &&
         all_of(texts.sizes) && all_of(texts.contrasts) && all_of(texts.switches) &&
         all_of(texts.motions);
}

}  // namespace

const MenuTexts& TextsOfMenu(std::string_view language, const render::CaptionFont& font) {
  const Known* known = Find(language);
  return known != nullptr && CanWrite(font, known->texts) ? known->texts : All().at("en").texts;
}

std::string NameOfLanguage(const std::string& language, const render::CaptionFont& font) {
  const Known* known = Find(language);
  return known != nullptr && show::CanWrite(font, known->name) ? known->name : language;
}

}  // namespace lararium::player
