#include "player/staff/staff_texts.h"

#include <algorithm>
#include <cstdlib>

#include "shared/core/json.h"

namespace lararium::player {
namespace {

// The texts of words.json: an object for each key, with a text for each language.
const Json& Words() {
  static const Json words = [] {
    const auto files = StaffPageFiles();
    const auto found = std::find_if(files.begin(), files.end(),
                                    [](const EmbeddedText& f) { return f.name == "words.json"; });
    return ParseJson(found->text, "words.json").value();
  }();
  return words;
}

// The texts as JSON. They contain nothing that could end the HTML element around them.
std::string WordsAsJson(const std::string& language) {
  Json words = Json::object();
  for (const auto& [key, texts] : Words().items()) {
    words[key] = texts[language];
  }
  std::string safe;
  for (const char c : words.dump()) {
    safe += c == '<' ? "\\u003c" : std::string(1, c);
  }
  return safe;
}

std::string Replacement(const std::string& key, const std::string& language) {
  if (key == "language") {
    return language;
  }
  if (key == "words") {
    return WordsAsJson(language);
  }
  return Words().contains(key) ? Words()[key][language].get<std::string>() : key;
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
  const std::string tag(language);
  std::string_view page = StaffPageFiles().front().text;
  std::string filled;
  while (true) {
    const size_t begin = page.find("{{");
    const size_t end = page.find("}}", begin);
    if (begin == std::string_view::npos || end == std::string_view::npos) {
      return filled += page;
    }
    filled += page.substr(0, begin);
    filled += Replacement(std::string(page.substr(begin + 2, end - begin - 2)), tag);
    page.remove_prefix(end + 2);
  }
}

}  // namespace lararium::player
