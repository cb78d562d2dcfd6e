#include "player/menu_texts.h"

#include <algorithm>
#include <iterator>

#include "shared/show/guide_texts.h"

namespace lararium::player {
namespace {

struct Known {
  std::string_view language;
  std::string_view name;
  std::string_view louder, quieter, spoken, captions, off, restart, find_anew, close;
};

constexpr Known kKnown[] = {
    {"en", "English", "Louder", "Quieter", "Voices", "Captions", "off", "From the beginning",
     "Find the place again", "Close"},
    {"la", "Latina", "Clarius", "Lenius", "Voces", "Inscriptiones", "nullae", "Ab initio",
     "Locum denuo quaere", "Claude"},
    {"de", "Deutsch", "Lauter", "Leiser", "Stimmen", "Untertitel", "aus", "Von vorn",
     "Ort neu suchen", "Schließen"},
    {"el", "Ελληνικά", "Πιο δυνατά", "Πιο σιγά", "Φωνές", "Υπότιτλοι", "χωρίς", "Από την αρχή",
     "Εύρεση του χώρου ξανά", "Κλείσιμο"},
    {"es", "Español", "Más alto", "Más bajo", "Voces", "Subtítulos", "no", "Desde el principio",
     "Buscar el lugar de nuevo", "Cerrar"},
    {"fr", "Français", "Plus fort", "Moins fort", "Voix", "Sous-titres", "sans", "Depuis le début",
     "Retrouver le lieu", "Fermer"},
    {"it", "Italiano", "Più forte", "Più piano", "Voci", "Sottotitoli", "no", "Dall'inizio",
     "Ritrova il luogo", "Chiudi"},
    {"nl", "Nederlands", "Harder", "Zachter", "Stemmen", "Ondertitels", "uit", "Vanaf het begin",
     "Plaats opnieuw zoeken", "Sluiten"},
    {"pt", "Português", "Mais alto", "Mais baixo", "Vozes", "Legendas", "não", "Desde o início",
     "Procurar o lugar de novo", "Fechar"},
};

const Known* Find(std::string_view language) {
  const std::string_view plain = language.substr(0, language.find('-'));
  const auto* found = std::find_if(std::begin(kKnown), std::end(kKnown),
                                   [&](const Known& k) { return k.language == plain; });
  return found == std::end(kKnown) ? nullptr : found;
}

bool CanWrite(const render::CaptionFont& font, const Known& known) {
  const std::string_view texts[] = {known.louder, known.quieter, known.spoken,    known.captions,
                                    known.off,    known.restart, known.find_anew, known.close};
  return std::all_of(std::begin(texts), std::end(texts),
                     [&](std::string_view text) { return show::CanWrite(font, text); });
}

}  // namespace

MenuTexts TextsOfMenu(std::string_view language, const render::CaptionFont& font) {
  const Known* known = Find(language);
  if (known == nullptr || !CanWrite(font, *known)) {
    known = std::begin(kKnown);
  }
  const auto text = [](std::string_view view) { return std::string(view); };
  return {text(known->louder), text(known->quieter), text(known->spoken),    text(known->captions),
          text(known->off),    text(known->restart), text(known->find_anew), text(known->close)};
}

std::string NameOfLanguage(const std::string& language, const render::CaptionFont& font) {
  const Known* known = Find(language);
  return known != nullptr && show::CanWrite(font, known->name) ? std::string(known->name)
                                                               : language;
}

}  // namespace lararium::player
