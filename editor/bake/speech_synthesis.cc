#include "editor/bake/speech_synthesis.h"

#include <espeak-ng/speak_lib.h>

#include <algorithm>
#include <cstring>
#include <mutex>
#include <utility>

namespace lararium::bake {
namespace {

constexpr size_t kMaxText = 4000;      // bytes
constexpr double kMaxSeconds = 300.0;  // longer ones are no line

// What the engine's callback collects.
struct Collected {
  struct Event {
    bool is_word = false;
    std::string ipa;
    int64_t sample = 0;
    int text_position = 0;  // of a word: its first character, from 1
    int length = 0;         // of a word, characters
  };
  std::vector<int16_t> samples;
  std::vector<Event> events;
  int rate = 0;
};

Collected* g_collected = nullptr;  // guarded by the engine's mutex

int Collect(short* samples, int count, espeak_EVENT* events) {
  Collected& collected = *g_collected;
  if (samples != nullptr) {
    collected.samples.insert(collected.samples.end(), samples, samples + count);
  }
  for (; events->type != espeakEVENT_LIST_TERMINATED; ++events) {
    if (events->type == espeakEVENT_PHONEME) {
      const size_t length = strnlen(events->id.string, sizeof(events->id.string));
      collected.events.push_back(
          {false, std::string(events->id.string, length), events->sample, 0, 0});
    } else if (events->type == espeakEVENT_WORD) {
      collected.events.push_back({true, "", events->sample, events->text_position, events->length});
    }
  }
  const double seconds = static_cast<double>(collected.samples.size()) / collected.rate;
  return seconds > kMaxSeconds ? 1 : 0;
}

// The engine, which there is one of.
class Engine {
 public:
  static Engine& Get() {
    static Engine engine;
    return engine;
  }

  std::mutex& mutex() { return mutex_; }

  Status SetVoice(const std::string& language, const VoiceSettings& voice) {
    if (rate_ <= 0) {
      return Status::Error("espeak-ng", "cannot be started", "install espeak-ng-data");
    }
    if (espeak_SetVoiceByName(language.c_str()) != EE_OK) {
      return Status::Error("espeak-ng", "does not speak the language '" + language + "'",
                           "record its lines, or leave it out of \"spoken\"");
    }
    if (!voice.variant.empty() &&
        espeak_SetVoiceByName((language + "+" + voice.variant).c_str()) != EE_OK) {
      return Status::Error("espeak-ng", "has no voice '" + voice.variant + "'",
                           "use m1 to m8, f1 to f5 or another of its variants");
    }
    espeak_SetParameter(espeakRATE, voice.rate, 0);
    espeak_SetParameter(espeakPITCH, voice.pitch, 0);
    espeak_SetParameter(espeakRANGE, voice.range, 0);
    espeak_SetParameter(espeakVOLUME, 100, 0);
    return Status();
  }

  Collected Speak(const std::string& text) {
    Collected collected;
    collected.rate = rate_;
    g_collected = &collected;
    espeak_Synth(text.c_str(), text.size() + 1, 0, POS_CHARACTER, 0,
                 espeakCHARS_UTF8 | espeakENDPAUSE, nullptr, nullptr);
    espeak_Synchronize();
    g_collected = nullptr;
    return collected;
  }

  bool Knows(const std::string& language) {
    return rate_ > 0 && espeak_SetVoiceByName(language.c_str()) == EE_OK;
  }

 private:
  Engine() {
    rate_ = espeak_Initialize(AUDIO_OUTPUT_SYNCHRONOUS, 0, nullptr,
                              espeakINITIALIZE_PHONEME_EVENTS | espeakINITIALIZE_PHONEME_IPA |
                                  espeakINITIALIZE_DONT_EXIT);
    espeak_SetSynthCallback(Collect);
  }

  std::mutex mutex_;
  int rate_ = 0;
};

// The characters [first, first + count) of a text, first from 0.
std::string Characters(const std::string& text, int first, int count) {
  std::string part;
  int at = -1;
  for (const char c : text) {
    at += (static_cast<unsigned char>(c) & 0xC0) != 0x80 ? 1 : 0;
    if (at >= first && at < first + count) {
      part += c;
    }
  }
  return part;
}

// Sounds one after the other; the engine marks pauses within a sound (before the release
// of a tap, between words said as one) by events without a name, which belong to what is
// before them.
std::vector<Phoneme> JoinPhonemes(const std::string& text,
                                  const Collected& collected,
                                  std::vector<std::string>& words) {
  constexpr double kShortestPause = 0.06;  // seconds
  std::vector<Phoneme> phonemes;
  int word = -1;
  for (const Collected::Event& event : collected.events) {
    if (event.is_word) {
      if (event.length > 0) {
        words.push_back(Characters(text, event.text_position - 1, event.length));
        word = static_cast<int>(words.size()) - 1;
      }
      continue;
    }
    const double begin = static_cast<double>(event.sample) / collected.rate;
    if (!phonemes.empty()) {
      phonemes.back().end = std::max(begin, phonemes.back().begin);
    }
    const bool pause = event.ipa.empty();
    phonemes.push_back({event.ipa, begin, begin, pause ? -1 : word});
  }
  if (!phonemes.empty()) {
    phonemes.back().end = static_cast<double>(collected.samples.size()) / collected.rate;
    phonemes.front().begin = 0.0;
  }
  std::vector<Phoneme> joined;
  for (Phoneme& phoneme : phonemes) {
    const bool pause = phoneme.ipa.empty();
    const double length = phoneme.end - phoneme.begin;
    if (length <= 0.0) {
      continue;
    }
    if (pause && !joined.empty() && (joined.back().ipa.empty() || length < kShortestPause)) {
      joined.back().end = phoneme.end;
    } else {
      joined.push_back(std::move(phoneme));
    }
  }
  return joined;
}

}  // namespace

Status VoiceSettings::Validate(const std::string& place) const {
  const auto is_plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
  };
  if (variant.size() > 32 || !std::all_of(variant.begin(), variant.end(), is_plain)) {
    return Status::Error(place, "\"variant\" is no name of a voice", "use m1 to m8 or f1 to f5");
  }
  if (pitch < 0 || pitch > 99 || range < 0 || range > 99) {
    return Status::Error(place, "\"pitch\" and \"range\" must lie between 0 and 99");
  }
  if (rate < espeakRATE_MINIMUM || rate > espeakRATE_MAXIMUM) {
    return Status::Error(place, "\"rate\" must lie between 80 and 450 words a minute");
  }
  return Status();
}

Result<SpokenText> Synthesize(const std::string& text,
                              const std::string& language,
                              const VoiceSettings& voice) {
  LARARIUM_RETURN_IF_ERROR(voice.Validate("voice"));
  if (text.size() > kMaxText) {
    return Status::Error("speech", "the text is longer than 4000 bytes", "split the line");
  }
  Engine& engine = Engine::Get();
  const std::lock_guard lock(engine.mutex());
  LARARIUM_RETURN_IF_ERROR(engine.SetVoice(language, voice));
  Collected collected = engine.Speak(text);
  SpokenText spoken;
  spoken.rate = collected.rate;
  spoken.phonemes = JoinPhonemes(text, collected, spoken.words);
  const bool silent = std::none_of(spoken.phonemes.begin(), spoken.phonemes.end(),
                                   [](const Phoneme& p) { return !p.ipa.empty(); });
  if (silent) {
    return Status::Error("speech", "there is nothing to say in \"" + text + "\"");
  }
  if (collected.samples.size() > static_cast<size_t>(kMaxSeconds * collected.rate)) {
    return Status::Error("speech", "the line lasts longer than five minutes", "split it");
  }
  spoken.samples = std::move(collected.samples);
  return spoken;
}

bool CanSynthesize(const std::string& language) {
  Engine& engine = Engine::Get();
  const std::lock_guard lock(engine.mutex());
  return engine.Knows(language);
}

}  // namespace lararium::bake
