#include "player/staff/staff_texts.h"

#include <algorithm>
#include <cstdlib>
#include <iterator>

#include "shared/core/json.h"

namespace lararium::player {
namespace {

struct Word {
  std::string_view key;
  std::string_view english;
  std::string_view italian;
};

constexpr Word kWords[] = {
    {"staff_page", "Staff page", "Pagina del personale"},
    {"connecting", "Asking the player …", "Domando al player …"},
    {"no_connection", "No connection to the player", "Nessun collegamento con il player"},
    {"no_answer", "The show does not answer", "Lo spettacolo non risponde"},
    {"starting", "The show is starting", "Lo spettacolo si avvia"},
    {"silent_for", "silent for", "muto da"},
    {"playing", "Somebody is watching", "Qualcuno sta guardando"},
    {"idle", "Waiting for a visitor", "In attesa di un visitatore"},
    {"plays", "The show is running", "Lo spettacolo è in corso"},
    {"no_picture", "No picture", "Nessuna immagine"},
    {"mirror", "What the visitor sees", "Quello che vede il visitatore"},
    {"show_time", "Time in the show", "Tempo dello spettacolo"},
    {"tracking", "Tracking", "Tracciamento"},
    {"place", "Place", "Luogo"},
    {"following", "Follows the place", "Segue il luogo"},
    {"lost", "Lost", "Perso"},
    {"searching", "Looks for the place", "Cerca il luogo"},
    {"too dark", "too dark, or something covers the camera",
     "troppo buio, o qualcosa copre la telecamera"},
    {"too few features", "sees hardly anything: a wall, a hand, a blur",
     "non vede quasi nulla: un muro, una mano, mosso"},
    {"too few matches", "sees another place, or another light",
     "vede un altro luogo, o un'altra luce"},
    {"no consistent pose", "what it sees does not fit together", "ciò che vede non combacia"},
    {"tracked_minute", "Tracked, last minute", "Tracciato, ultimo minuto"},
    {"tracked_all", "Tracked since the start", "Tracciato dall'avvio"},
    {"confidence", "Confidence", "Affidabilità"},
    {"losses", "Losses", "Perdite"},
    {"picture", "Picture", "Immagine"},
    {"rate", "Pictures a second", "Immagini al secondo"},
    {"quality", "Level of quality", "Livello di qualità"},
    {"finest", "finest", "il più fine"},
    {"machine", "Machine", "Macchina"},
    {"battery", "Battery", "Batteria"},
    {"charging", "charging", "in carica"},
    {"discharging", "not charging", "non in carica"},
    {"no_battery", "none, or not known", "assente o non nota"},
    {"temperature", "Temperature", "Temperatura"},
    {"unknown", "not known", "non nota"},
    {"memory", "Memory", "Memoria"},
    {"running", "Running for", "In funzione da"},
    {"restarts", "Restarts", "Riavvii"},
    {"version", "Version", "Versione"},
    {"sound", "Sound and language", "Suono e lingua"},
    {"volume", "Volume", "Volume"},
    {"silent", "no sound", "senza suono"},
    {"voices", "Voices", "Voci"},
    {"captions", "Captions", "Sottotitoli"},
    {"off", "off", "no"},
    {"caption_size", "Letters", "Lettere"},
    {"caption_contrast", "Contrast", "Contrasto"},
    {"descriptions", "Descriptions", "Descrizioni"},
    {"on", "on", "sì"},
    {"reduced_motion", "Reduced motion", "Movimento ridotto"},
    {"normal", "normal", "normale"},
    {"large", "large", "grandi"},
    {"largest", "largest", "molto grandi"},
    {"high", "high", "alto"},
    {"authors_choice", "as the author chose", "come scelto dall'autore"},
    {"control", "Control", "Comandi"},
    {"read_only", "This page only shows: the player was started without a PIN.",
     "Questa pagina mostra soltanto: il player è stato avviato senza PIN."},
    {"pin", "PIN", "PIN"},
    {"unlock", "Unlock", "Sblocca"},
    {"lock", "Lock", "Blocca"},
    {"wrong_pin", "This is not the PIN.", "Non è il PIN giusto."},
    {"locked", "Too many wrong tries. The next one is taken in",
     "Troppi tentativi sbagliati. Il prossimo vale fra"},
    {"restart", "From the beginning", "Dall'inizio"},
    {"find_anew", "Find the place again", "Ritrova il luogo"},
    {"louder", "Louder", "Più forte"},
    {"quieter", "Quieter", "Più piano"},
    {"begin_again", "Restart the player", "Riavvia il player"},
    {"begin_again_sure", "Restart the player? The visitor sees nothing for some seconds.",
     "Riavviare il player? Il visitatore non vede nulla per alcuni secondi."},
    {"end", "Stop the player", "Ferma il player"},
    {"end_sure", "Stop the player? This page goes with it.",
     "Fermare il player? Anche questa pagina si chiude."},
    {"not_done", "That did not work:", "Non è riuscito:"},
    {"warnings", "Last warnings", "Ultimi avvisi"},
    {"no_warnings", "None", "Nessuno"},
    {"ago", "{} ago", "{} fa"},
    {"statistics", "Days", "Giorni"},
    {"no_statistics", "Days are counted where the player runs with --kiosk.",
     "I giorni si contano quando il player gira con --kiosk."},
    {"day", "Day", "Giorno"},
    {"visitors", "Visitors", "Visitatori"},
    {"minutes", "Minutes", "Minuti"},
    {"completed", "To the end", "Fino alla fine"},
    {"tracked", "Tracked", "Tracciato"},
    {"download", "All days as a table (CSV)", "Tutti i giorni come tabella (CSV)"},
};

std::string_view TextOf(const Word& word, std::string_view language) {
  return language == "it" ? word.italian : word.english;
}

// The texts as JSON. It contains nothing that could end the HTML element around it.
std::string WordsAsJson(std::string_view language) {
  Json words = Json::object();
  for (const Word& word : kWords) {
    words[std::string(word.key)] = TextOf(word, language);
  }
  std::string safe;
  for (const char c : words.dump()) {
    safe += c == '<' ? "\\u003c" : std::string(1, c);
  }
  return safe;
}

std::string Replacement(std::string_view key, std::string_view language) {
  if (key == "language") {
    return std::string(language);
  }
  if (key == "words") {
    return WordsAsJson(language);
  }
  const auto* found = std::find_if(std::begin(kWords), std::end(kWords),
                                   [&](const Word& word) { return word.key == key; });
  return found == std::end(kWords) ? std::string(key) : std::string(TextOf(*found, language));
}

// The weight of an entry such as "it-IT;q=0.8".
double WeightOf(std::string_view entry) {
  const size_t at = entry.find("q=");
  return at == std::string_view::npos
             ? 1.0
             : std::strtod(std::string(entry.substr(at + 2)).c_str(), nullptr);
}

}  // namespace

std::string_view StaffLanguage(std::string_view accept_language) {
  std::string_view best = "en";
  double best_weight = 0.0;
  while (!accept_language.empty()) {
    std::string_view entry = accept_language.substr(0, accept_language.find(','));
    accept_language.remove_prefix(std::min(entry.size() + 1, accept_language.size()));
    entry.remove_prefix(std::min(entry.find_first_not_of(' '), entry.size()));
    const std::string_view plain = entry.substr(0, entry.find_first_of("-;"));
    const double weight = WeightOf(entry);
    for (const std::string_view language : {"en", "it"}) {
      if (plain == language && weight > best_weight) {
        best = language;
        best_weight = weight;
      }
    }
  }
  return best;
}

std::string StaffPageIn(std::string_view language) {
  std::string_view page = StaffPageFiles().front().text;
  std::string filled;
  while (true) {
    const size_t begin = page.find("{{");
    const size_t end = page.find("}}", begin);
    if (begin == std::string_view::npos || end == std::string_view::npos) {
      return filled += page;
    }
    filled += page.substr(0, begin);
    filled += Replacement(page.substr(begin + 2, end - begin - 2), language);
    page.remove_prefix(end + 2);
  }
}

}  // namespace lararium::player
