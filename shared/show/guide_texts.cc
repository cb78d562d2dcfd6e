#include "shared/show/guide_texts.h"

#include <algorithm>
#include <iterator>

#include "shared/core/utf8.h"

namespace lararium::show {
namespace {

struct Known {
  std::string_view language;
  std::string_view look;
  std::string_view dark;
  std::string_view farewell;
};

constexpr Known kKnown[] = {
    {"en", "Please look this way", "It is too dark here,\nor something covers the camera",
     "That was it, thank you.\nPlease hand the headset back"},
    {"la", "Quaeso, huc specta", "Nimis obscurum est,\naut aliquid oculum machinae tegit",
     "Finis est, gratias.\nMachinam, quaeso, redde"},
    {"de", "Bitte hierhin schauen", "Es ist zu dunkel,\noder etwas verdeckt die Kamera",
     "Das war es, vielen Dank.\nBitte geben Sie die Brille wieder ab"},
    {"el", "Παρακαλώ, κοιτάξτε προς τα εδώ", "Είναι πολύ σκοτεινά\nή κάτι καλύπτει την κάμερα",
     "Αυτό ήταν, ευχαριστούμε.\nΠαρακαλώ, επιστρέψτε τη συσκευή"},
    {"es", "Mire hacia aquí, por favor", "Está demasiado oscuro\no algo tapa la cámara",
     "Esto es todo, gracias.\nDevuelva el visor, por favor"},
    {"fr", "Veuillez regarder par ici", "Il fait trop sombre\nou quelque chose couvre la caméra",
     "C'est fini, merci.\nVeuillez rendre le casque"},
    {"it", "Guardi da questa parte, per favore", "È troppo buio\no qualcosa copre la telecamera",
     "È tutto, grazie.\nRestituisca il visore, per favore"},
    {"nl", "Kijk alstublieft deze kant op", "Het is te donker\nof iets bedekt de camera",
     "Dat was het, dank u.\nGeef de bril alstublieft terug"},
    {"pt", "Olhe para este lado, por favor", "Está escuro demais\nou algo cobre a câmara",
     "É tudo, obrigado.\nDevolva os óculos, por favor"},
};

}  // namespace

bool CanWrite(const render::CaptionFont& font, std::string_view text) {
  for (size_t at = 0; at < text.size();) {
    const uint32_t character = NextCharacter(text, at);
    if (character != '\n' && font.Find(character) == nullptr) {
      return false;
    }
  }
  return true;
}

GuideTexts BuiltInGuide(std::string_view language, const render::CaptionFont* font) {
  const std::string_view plain = language.substr(0, language.find('-'));
  const auto* known = std::find_if(std::begin(kKnown), std::end(kKnown),
                                   [&](const Known& k) { return k.language == plain; });
  if (known == std::end(kKnown) ||
      (font != nullptr && !(CanWrite(*font, known->look) && CanWrite(*font, known->dark) &&
                            CanWrite(*font, known->farewell)))) {
    known = std::begin(kKnown);
  }
  return {std::string(known->look), std::string(known->dark), std::string(known->farewell)};
}

}  // namespace lararium::show
