#include "editor/export/qr_page.h"

#include <qrencode.h>

#include <algorithm>
#include <cstring>
#include <iterator>
#include <memory>
#include <string_view>

#include "shared/core/html_text.h"

namespace lararium::exporter {
namespace {

constexpr int kBorder = 4;  // Modules.

struct Sentence {
  std::string_view language;
  std::string_view text;
};

constexpr Sentence kSentences[] = {
    {"en", "Point your phone's camera at this code: people of the past stand here."},
    {"la", "Machinam telephonicam ad hoc signum dirige: homines antiqui hic stant."},
    {"de",
     "Richten Sie die Kamera Ihres Telefons auf diesen Code: Hier stehen Menschen von damals."},
    {"el",
     "Στρέψτε την κάμερα του κινητού σας σε αυτόν τον κωδικό: εδώ στέκονται άνθρωποι του "
     "παρελθόντος."},
    {"es", "Apunte la cámara de su teléfono a este código: aquí hay personas del pasado."},
    {"fr",
     "Dirigez l'appareil photo de votre téléphone vers ce code : des gens du passé se tiennent "
     "ici."},
    {"it",
     "Inquadri questo codice con la fotocamera del telefono: qui ci sono persone del passato."},
    {"nl", "Richt de camera van uw telefoon op deze code: hier staan mensen van vroeger."},
    {"pt", "Aponte a câmara do seu telemóvel para este código: aqui estão pessoas do passado."},
};

const Sentence& SentenceIn(std::string_view language) {
  const std::string_view plain = language.substr(0, language.find('-'));
  const auto* found = std::find_if(std::begin(kSentences), std::end(kSentences),
                                   [&](const Sentence& s) { return s.language == plain; });
  return found == std::end(kSentences) ? kSentences[0] : *found;
}

}  // namespace

Result<std::string> MakeQrCodeSvg(const std::string& address) {
  struct Free {
    void operator()(QRcode* code) const { QRcode_free(code); }
  };
  // The smallest code that holds the text. A seventh of it may be dirty or torn.
  const std::unique_ptr<QRcode, Free> code(
      QRcode_encodeString8bit(address.c_str(), 0, QR_ECLEVEL_M));
  if (!code) {
    return Status::Error(address, "is too long for a code", "give a shorter address");
  }
  const std::string side = std::to_string(code->width + 2 * kBorder);
  std::string svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + side + " " + side +
                    "\" shape-rendering=\"crispEdges\"><title>" + EscapeHtml(address) +
                    "</title><path fill=\"#fff\" d=\"M0 0h" + side + "v" + side +
                    "H0z\"/><path d=\"";
  for (int y = 0; y < code->width; ++y) {
    for (int x = 0; x < code->width; ++x) {
      if ((code->data[y * code->width + x] & 1) != 0) {
        svg += "M" + std::to_string(x + kBorder) + " " + std::to_string(y + kBorder) + "h1v1h-1z";
      }
    }
  }
  return svg + "\"/></svg>\n";
}

Result<std::string> MakeQrPage(const std::string& title,
                               const std::string& address,
                               std::span<const std::string> languages) {
  LARARIUM_ASSIGN_OR_RETURN(const std::string code, MakeQrCodeSvg(address));
  std::string sentences;
  std::string_view first;
  for (const std::string& language : languages) {
    const Sentence& sentence = SentenceIn(language);
    if (sentences.find(sentence.text) == std::string::npos) {
      first = first.empty() ? sentence.language : first;
      sentences += "<p lang=\"" + std::string(sentence.language) + "\">" +
                   std::string(sentence.text) + "</p>\n";
    }
  }
  if (sentences.empty()) {
    first = "en";
    sentences = "<p>" + std::string(SentenceIn("en").text) + "</p>\n";
  }
  return "<!doctype html>\n<html lang=\"" + std::string(first) +
         "\">\n<head>\n<meta charset=\"utf-8\">\n<title>" + EscapeHtml(title) +
         "</title>\n<style>\n@page { size: A4; margin: 20mm; }\n"
         "body { font: 16pt/1.4 Georgia, serif; text-align: center; color: #000; background: #fff; "
         "}\n"
         "h1 { font-size: 28pt; }\nsvg { width: 110mm; max-width: 90vw; }\n"
         "code { font-size: 12pt; overflow-wrap: anywhere; "
         "}\n</style>\n</head>\n<body>\n<main>\n<h1>" +
         EscapeHtml(title) + "</h1>\n" + sentences + code + "<p><code>" + EscapeHtml(address) +
         "</code></p>\n</main>\n</body>\n</html>\n";
}

}  // namespace lararium::exporter
