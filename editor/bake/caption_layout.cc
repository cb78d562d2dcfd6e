#include "editor/bake/caption_layout.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lararium::bake {
namespace {

std::vector<std::string> Words(const std::string& text) {
  std::vector<std::string> words;
  size_t at = 0;
  while (at < text.size()) {
    const size_t begin = text.find_first_not_of(" \t\r\n", at);
    if (begin == std::string::npos) {
      break;
    }
    at = std::min(text.find_first_of(" \t\r\n", begin), text.size());
    words.push_back(text.substr(begin, at - begin));
  }
  return words;
}

// Cost of a row break after a word, on the scale of squared letters of unevenness.
double BreakPenalty(const std::string& word) {
  const char last = word.back();
  if (last == '.' || last == '!' || last == '?') {
    return 0.0;
  }
  if (last == ',' || last == ';' || last == ':') {
    return 40.0;
  }
  return CountLetters(word) <= 3 ? 260.0 : 160.0;  // The larger cost avoids breaks after articles.
}

// The middle of each silence of the voice that is long enough to be heard.
std::vector<double> Pauses(const human::VisemeTrack& visemes) {
  constexpr double kHeard = 0.12;  // seconds
  std::vector<double> pauses;
  for (size_t i = 1; i + 1 < visemes.keys.size(); ++i) {
    const double begin = visemes.keys[i].time;
    const double end = visemes.keys[i + 1].time;
    if (visemes.keys[i].viseme == human::Viseme::kSil && end - begin >= kHeard) {
      pauses.push_back(0.5 * (begin + end));
    }
  }
  return pauses;
}

double Snapped(double time, const std::vector<double>& pauses) {
  constexpr double kNear = 0.6;  // seconds
  double best = time;
  double away = kNear;
  for (const double pause : pauses) {
    if (std::abs(pause - time) < away) {
      away = std::abs(pause - time);
      best = pause;
    }
  }
  return best;
}

}  // namespace

size_t CountLetters(std::string_view text) {
  size_t count = 0;
  for (size_t i = 0; i < text.size(); ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    const auto next = i + 1 < text.size() ? static_cast<unsigned char>(text[i + 1]) : 0u;
    // U+0300 to U+036F are 0xCC 0x80 to 0xCD 0xAF.
    const bool combines = byte == 0xCC || (byte == 0xCD && next < 0xB0);
    count += (byte & 0xC0) != 0x80 && !combines ? 1 : 0;
  }
  return count;
}

// Finds the breaks of least cost; best[i] is the cost of the words from i on (Knuth & Plass,
// Breaking Paragraphs into Lines, 1981, applied to rows).
std::vector<std::string> BreakRows(const std::string& text, const CaptionRules& rules) {
  const std::vector<std::string> words = Words(text);
  if (words.empty()) {
    return {};
  }
  size_t letters = words.size() - 1;
  for (const std::string& word : words) {
    letters += CountLetters(word);
  }
  const double rows = std::ceil(static_cast<double>(letters) / static_cast<double>(rules.letters));
  const double even = static_cast<double>(letters) / rows;
  std::vector<double> best(words.size() + 1, std::numeric_limits<double>::infinity());
  std::vector<size_t> next(words.size() + 1, words.size());
  best[words.size()] = 0.0;
  for (size_t i = words.size(); i-- > 0;) {
    size_t length = 0;
    for (size_t j = i; j < words.size(); ++j) {
      length += CountLetters(words[j]) + (j > i ? 1 : 0);
      if (length > rules.letters && j > i) {
        break;
      }
      const double uneven = static_cast<double>(length) - even;
      const double ending = j + 1 == words.size() ? 0.0 : BreakPenalty(words[j]) + 100.0;
      const double cost = uneven * uneven + ending + best[j + 1];
      if (cost < best[i]) {
        best[i] = cost;
        next[i] = j + 1;
      }
    }
  }
  std::vector<std::string> broken;
  for (size_t i = 0; i < words.size(); i = next[i]) {
    std::string row = words[i];
    for (size_t j = i + 1; j < next[i]; ++j) {
      row += " " + words[j];
    }
    broken.push_back(std::move(row));
  }
  return broken;
}

std::vector<stage::CaptionCue> LayOutCaptions(const std::string& text,
                                              const human::VisemeTrack& visemes,
                                              const CaptionRules& rules) {
  const std::vector<std::string> rows = BreakRows(text, rules);
  std::vector<stage::CaptionCue> cues;
  for (size_t i = 0; i < rows.size(); i += 2) {
    const bool two = i + 1 < rows.size();
    cues.push_back({0.0, 0.0, two ? rows[i] + "\n" + rows[i + 1] : rows[i]});
  }
  double all = 0.0;
  for (const stage::CaptionCue& cue : cues) {
    all += static_cast<double>(CountLetters(cue.text));
  }
  const std::vector<double> pauses = Pauses(visemes);
  double share = 0.0;
  double begin = 0.0;
  for (size_t i = 0; i < cues.size(); ++i) {
    const auto letters = static_cast<double>(CountLetters(cues[i].text));
    share += letters / std::max(all, 1.0);
    const double needed = std::max(rules.seconds, letters / rules.letters_per_second);
    cues[i].begin = begin;
    cues[i].end = std::max(Snapped(share * visemes.duration, pauses), begin + 0.2);
    if (i + 1 == cues.size()) {
      const double latest = static_cast<double>(visemes.duration) + rules.reading_on;
      cues[i].end = std::max(std::max(static_cast<double>(visemes.duration), begin + 0.2),
                             std::min(begin + needed, latest));
    }
    // Rounds to milliseconds, the resolution of the files.
    cues[i].end = std::round(cues[i].end * 1000.0) / 1000.0;
    begin = cues[i].end;
  }
  return cues;
}

double ReadingSpeed(std::span<const stage::CaptionCue> cues) {
  double fastest = 0.0;
  for (const stage::CaptionCue& cue : cues) {
    fastest =
        std::max(fastest, static_cast<double>(CountLetters(cue.text)) / (cue.end - cue.begin));
  }
  return fastest;
}

}  // namespace lararium::bake
