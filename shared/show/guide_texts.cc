#include "shared/show/guide_texts.h"

#include <algorithm>
#include <iterator>

namespace lararium::show {
namespace {

struct Known {
  std::string_view language;
  std::string_view look;
  std::string_view dark;
};

constexpr Known kKnown[] = {
    {"en", "Please look this way", "It is too dark here,\nor something covers the camera"},
    {"la", "Quaeso, huc specta", "Nimis obscurum est,\naut aliquid oculum machinae tegit"},
    {"de", "Bitte hierhin schauen", "Es ist zu dunkel,\noder etwas verdeckt die Kamera"},
    {"el", "Παρακαλώ, κοιτάξτε προς τα εδώ", "Είναι πολύ σκοτεινά\nή κάτι καλύπτει την κάμερα"},
    {"es", "Mire hacia aquí, por favor", "Está demasiado oscuro\no algo tapa la cámara"},
    {"fr", "Veuillez regarder par ici", "Il fait trop sombre\nou quelque chose couvre la caméra"},
    {"it", "Guardi da questa parte, per favore", "È troppo buio\no qualcosa copre la telecamera"},
    {"nl", "Kijk alstublieft deze kant op", "Het is te donker\nof iets bedekt de camera"},
    {"pt", "Olhe para este lado, por favor", "Está escuro demais\nou algo cobre a câmara"},
};

}  // namespace

bool CanWrite(const render::CaptionFont& font, std::string_view text) {
  for (size_t at = 0; at < text.size();) {
    const uint32_t character = render::NextCharacter(text, at);
    if (character != '\n' && font.Find(character) == nullptr) {
      return false;
    }
  }
  return true;
}

GuideTexts BuiltInGuide(std::string_view language, const render::CaptionFont& font) {
  const std::string_view plain = language.substr(0, language.find('-'));
  const auto* known = std::find_if(std::begin(kKnown), std::end(kKnown),
                                   [&](const Known& k) { return k.language == plain; });
  if (known == std::end(kKnown) || !CanWrite(font, known->look) || !CanWrite(font, known->dark)) {
    known = std::begin(kKnown);
  }
  return {std::string(known->look), std::string(known->dark)};
}

}  // namespace lararium::show
