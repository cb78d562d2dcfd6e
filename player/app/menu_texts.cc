#include "player/app/menu_texts.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <span>

#include "shared/show/guide_texts.h"

namespace lararium::player {
namespace {

struct Known {
  std::string_view language;
  std::string_view name;
  MenuTexts texts;
};

constexpr Known kKnown[] = {
    {"en",
     "English",
     {"Louder",
      "Quieter",
      "Voices",
      "Captions",
      "off",
      "Letters",
      {"normal", "large", "largest"},
      "Contrast",
      {"normal", "high"},
      "Descriptions",
      {"off", "on"},
      "Motion",
      {"all", "reduced"},
      "From the beginning",
      "Find the place again",
      "Close"}},
    {"la",
     "Latina",
     {"Clarius",
      "Lenius",
      "Voces",
      "Inscriptiones",
      "nullae",
      "Litterae",
      {"mediae", "magnae", "maximae"},
      "Fundus",
      {"translucens", "niger"},
      "Descriptiones",
      {"nullae", "audiuntur"},
      "Motus",
      {"omnis", "minor"},
      "Ab initio",
      "Locum denuo quaere",
      "Claude"}},
    {"de",
     "Deutsch",
     {"Lauter",
      "Leiser",
      "Stimmen",
      "Untertitel",
      "aus",
      "Schrift",
      {"normal", "groß", "sehr groß"},
      "Kontrast",
      {"normal", "hoch"},
      "Beschreibungen",
      {"aus", "an"},
      "Bewegung",
      {"normal", "weniger"},
      "Von vorn",
      "Ort neu suchen",
      "Schließen"}},
    {"el",
     "Ελληνικά",
     {"Πιο δυνατά",
      "Πιο σιγά",
      "Φωνές",
      "Υπότιτλοι",
      "χωρίς",
      "Γράμματα",
      {"κανονικά", "μεγάλα", "μέγιστα"},
      "Αντίθεση",
      {"κανονική", "υψηλή"},
      "Περιγραφές",
      {"χωρίς", "με"},
      "Κίνηση",
      {"πλήρης", "μειωμένη"},
      "Από την αρχή",
      "Εύρεση του χώρου ξανά",
      "Κλείσιμο"}},
    {"es",
     "Español",
     {"Más alto",
      "Más bajo",
      "Voces",
      "Subtítulos",
      "no",
      "Letras",
      {"normales", "grandes", "muy grandes"},
      "Contraste",
      {"normal", "alto"},
      "Descripciones",
      {"no", "sí"},
      "Movimiento",
      {"normal", "reducido"},
      "Desde el principio",
      "Buscar el lugar de nuevo",
      "Cerrar"}},
    {"fr",
     "Français",
     {"Plus fort",
      "Moins fort",
      "Voix",
      "Sous-titres",
      "sans",
      "Lettres",
      {"normales", "grandes", "très grandes"},
      "Contraste",
      {"normal", "élevé"},
      "Descriptions",
      {"sans", "avec"},
      "Mouvements",
      {"normaux", "réduits"},
      "Depuis le début",
      "Retrouver le lieu",
      "Fermer"}},
    {"it",
     "Italiano",
     {"Più forte",
      "Più piano",
      "Voci",
      "Sottotitoli",
      "no",
      "Lettere",
      {"normali", "grandi", "molto grandi"},
      "Contrasto",
      {"normale", "alto"},
      "Descrizioni",
      {"no", "sì"},
      "Movimento",
      {"normale", "ridotto"},
      "Dall'inizio",
      "Ritrova il luogo",
      "Chiudi"}},
    {"nl",
     "Nederlands",
     {"Harder",
      "Zachter",
      "Stemmen",
      "Ondertitels",
      "uit",
      "Letters",
      {"normaal", "groot", "heel groot"},
      "Contrast",
      {"normaal", "hoog"},
      "Beschrijvingen",
      {"uit", "aan"},
      "Beweging",
      {"normaal", "minder"},
      "Vanaf het begin",
      "Plaats opnieuw zoeken",
      "Sluiten"}},
    {"pt",
     "Português",
     {"Mais alto",
      "Mais baixo",
      "Vozes",
      "Legendas",
      "não",
      "Letras",
      {"normais", "grandes", "muito grandes"},
      "Contraste",
      {"normal", "alto"},
      "Descrições",
      {"não", "sim"},
      "Movimento",
      {"normal", "reduzido"},
      "Desde o início",
      "Procurar o lugar de novo",
      "Fechar"}},
};

const Known* Find(std::string_view language) {
  const std::string_view plain = language.substr(0, language.find('-'));
  const auto* found = std::find_if(std::begin(kKnown), std::end(kKnown),
                                   [&](const Known& k) { return k.language == plain; });
  return found == std::end(kKnown) ? nullptr : found;
}

bool CanWrite(const render::CaptionFont& font, const MenuTexts& texts) {
  const auto all_of = [&](std::span<const std::string_view> some) {
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
  return known != nullptr && CanWrite(font, known->texts) ? known->texts : kKnown[0].texts;
}

std::string NameOfLanguage(const std::string& language, const render::CaptionFont& font) {
  const Known* known = Find(language);
  return known != nullptr && show::CanWrite(font, known->name) ? std::string(known->name)
                                                               : language;
}

}  // namespace lararium::player
