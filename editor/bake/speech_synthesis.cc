#include "editor/bake/speech_synthesis.h"

#include <espeak-ng/speak_lib.h>
#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <utility>

#include "shared/core/fork.h"

namespace lararium::bake {
namespace {

constexpr size_t kMaxSynthesisText = 4000;      // bytes
constexpr double kMaxSynthesisSeconds = 300.0;  // Longer speech is not accepted as a line.
constexpr std::chrono::seconds kPatience(60);   // Time limit; the engine takes one or two seconds.

// What the engine's callback collects.
struct Collected {
  struct Event {
    bool is_word = false;
    std::string ipa;
    int64_t sample = 0;
    int text_position = 0;  // First character of a word, from 1.
    int length = 0;         // Characters of a word.
  };
  std::vector<int16_t> samples;
  std::vector<Event> events;
  int rate = 0;
};

Collected* g_collected = nullptr;  // Used only in the child process.

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
  return seconds > kMaxSynthesisSeconds ? 1 : 0;
}

enum class Outcome : int32_t { kSpoken, kNoEngine, kNoLanguage, kNoVariant };

Outcome SetVoice(const std::string& language, const VoiceSettings& voice) {
  if (espeak_SetVoiceByName(language.c_str()) != EE_OK) {
    return Outcome::kNoLanguage;
  }
  if (!voice.variant.empty()) {
    // The engine accepts any variant name and ignores unknown ones.
    const char* data = nullptr;
    espeak_Info(&data);
    const std::string file = std::string(data != nullptr ? data : "") + "/voices/!v/";
    if (access((file + voice.variant).c_str(), R_OK) != 0 ||
        espeak_SetVoiceByName((language + "+" + voice.variant).c_str()) != EE_OK) {
      return Outcome::kNoVariant;
    }
  }
  espeak_SetParameter(espeakRATE, voice.rate, 0);
  espeak_SetParameter(espeakPITCH, voice.pitch, 0);
  espeak_SetParameter(espeakRANGE, voice.range, 0);
  espeak_SetParameter(espeakVOLUME, 100, 0);
  return Outcome::kSpoken;
}

Outcome Speak(const std::string& text,
              const std::string& language,
              const VoiceSettings& voice,
              Collected& collected) {
  collected.rate = espeak_Initialize(
      AUDIO_OUTPUT_SYNCHRONOUS, 0, nullptr,
      espeakINITIALIZE_PHONEME_EVENTS | espeakINITIALIZE_PHONEME_IPA | espeakINITIALIZE_DONT_EXIT);
  if (collected.rate <= 0) {
    return Outcome::kNoEngine;
  }
  g_collected = &collected;
  espeak_SetSynthCallback(Collect);
  const Outcome outcome = SetVoice(language, voice);
  if (outcome == Outcome::kSpoken) {
    espeak_Synth(text.c_str(), text.size() + 1, 0, POS_CHARACTER, 0,
                 espeakCHARS_UTF8 | espeakENDPAUSE, nullptr, nullptr);
    espeak_Synchronize();
  }
  return outcome;
}

// ---- from the child process to its parent ----

class Pipe {
 public:
  explicit Pipe(int file) : file_(file), until_(std::chrono::steady_clock::now() + kPatience) {}

  template <typename T>
  void Put(const T& value) {
    PutBytes(&value, sizeof(T));
  }
  void PutBytes(const void* data, size_t size) {
    const char* at = static_cast<const char*>(data);
    while (size > 0 && good_) {
      const ssize_t written = write(file_, at, size);
      if (written < 0 && errno == EINTR) {
        continue;
      }
      good_ = written > 0;
      at += good_ ? written : 0;
      size -= good_ ? static_cast<size_t>(written) : 0;
    }
  }

  template <typename T>
  T Take() {
    T value = {};
    TakeBytes(&value, sizeof(T));
    return value;
  }
  void TakeBytes(void* data, size_t size) {
    char* at = static_cast<char*>(data);
    while (size > 0 && good_) {
      if (!Await()) {
        good_ = false;
        return;
      }
      const ssize_t taken = read(file_, at, size);
      if (taken < 0 && errno == EINTR) {
        continue;
      }
      good_ = taken > 0;
      at += good_ ? taken : 0;
      size -= good_ ? static_cast<size_t>(taken) : 0;
    }
  }
  bool good() const { return good_; }

 private:
  // Waits for data or for the end of the stream.
  bool Await() const {
    int found = -1;
    do {
      const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(
          until_ - std::chrono::steady_clock::now());
      pollfd waited = {file_, POLLIN, 0};
      found = poll(&waited, 1, static_cast<int>(std::max<int64_t>(left.count(), 0)));
    } while (found < 0 && errno == EINTR);
    return found > 0;
  }

  int file_;
  std::chrono::steady_clock::time_point until_;
  bool good_ = true;
};

void Send(Outcome outcome, const Collected& collected, Pipe pipe) {
  pipe.Put(outcome);
  pipe.Put(collected.rate);
  pipe.Put(collected.samples.size());
  pipe.PutBytes(collected.samples.data(), collected.samples.size() * sizeof(int16_t));
  pipe.Put(collected.events.size());
  for (const Collected::Event& event : collected.events) {
    pipe.Put(event.is_word);
    pipe.Put(event.sample);
    pipe.Put(event.text_position);
    pipe.Put(event.length);
    pipe.Put(event.ipa.size());
    pipe.PutBytes(event.ipa.data(), event.ipa.size());
  }
}

// False if the child ended before it sent everything.
bool Receive(Pipe pipe, Outcome& outcome, Collected& collected) {
  outcome = pipe.Take<Outcome>();
  collected.rate = pipe.Take<int>();
  collected.samples.resize(pipe.Take<size_t>());
  pipe.TakeBytes(collected.samples.data(), collected.samples.size() * sizeof(int16_t));
  collected.events.resize(pipe.Take<size_t>());
  for (Collected::Event& event : collected.events) {
    event.is_word = pipe.Take<bool>();
    event.sample = pipe.Take<int64_t>();
    event.text_position = pipe.Take<int>();
    event.length = pipe.Take<int>();
    event.ipa.resize(pipe.Take<size_t>());
    pipe.TakeBytes(event.ipa.data(), event.ipa.size());
  }
  return pipe.good();
}

// Runs in a separate process: the engine keeps state from earlier texts, down to the phase of
// the voice, and cannot be started twice in one process.
Result<Collected> SpeakApart(const std::string& text,
                             const std::string& language,
                             const VoiceSettings& voice) {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) {
    return Status::Error("espeak-ng", "cannot be started: the system has no free pipe");
  }
  const pid_t child = ForkApart();
  if (child == 0) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    close(ends[0]);
    Collected collected;
    Send(Speak(text, language, voice, collected), collected, Pipe(ends[1]));
    _exit(0);
  }
  close(ends[1]);
  Collected collected;
  Outcome outcome = Outcome::kNoEngine;
  const bool told = child > 0 && Receive(Pipe(ends[0]), outcome, collected);
  close(ends[0]);
  if (child > 0) {
    kill(child, SIGKILL);  // The child has sent everything, or never will.
    waitpid(child, nullptr, 0);
  }
  if (!told) {
    return Status::Error("espeak-ng", "gave no answer for '" + text + "'", "try again");
  }
  if (outcome == Outcome::kNoEngine) {
    return Status::Error("espeak-ng", "cannot be started", "install espeak-ng-data");
  }
  if (outcome == Outcome::kNoLanguage) {
    return Status::Error("espeak-ng", "does not speak the language '" + language + "'",
                         "record its lines, or leave it out of \"spoken\"");
  }
  if (outcome == Outcome::kNoVariant) {
    return Status::Error("espeak-ng", "has no voice '" + voice.variant + "'",
                         "use m1 to m8, f1 to f5 or another of its variants");
  }
  return collected;
}

// The characters [first, first + count) of a text; `first` counts from 0.
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

// Joins events to consecutive sounds. The engine marks pauses within a sound (before the
// release of a tap, between words said as one) by events without a name; they belong to the
// previous sound.
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

Status VoiceSettings::Validate(const std::string& where) const {
  const auto is_plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
  };
  if (variant.size() > 32 || !std::all_of(variant.begin(), variant.end(), is_plain)) {
    return Status::Error(where, "\"variant\" is not the name of a voice",
                         "use m1 to m8 or f1 to f5");
  }
  if (pitch < 0 || pitch > 99 || range < 0 || range > 99) {
    return Status::Error(where, "\"pitch\" and \"range\" must lie between 0 and 99");
  }
  if (rate < espeakRATE_MINIMUM || rate > espeakRATE_MAXIMUM) {
    return Status::Error(where, "\"rate\" must lie between 80 and 450 words a minute");
  }
  return Status();
}

Result<SpokenText> Synthesize(const std::string& text,
                              const std::string& language,
                              const VoiceSettings& voice) {
  LARARIUM_RETURN_IF_ERROR(voice.Validate("voice"));
  if (text.size() > kMaxSynthesisText) {
    return Status::Error("speech", "the text is longer than 4000 bytes", "split the line");
  }
  LARARIUM_ASSIGN_OR_RETURN(Collected collected, SpeakApart(text, language, voice));
  SpokenText spoken;
  spoken.rate = collected.rate;
  spoken.phonemes = JoinPhonemes(text, collected, spoken.words);
  const bool silent = std::none_of(spoken.phonemes.begin(), spoken.phonemes.end(),
                                   [](const Phoneme& p) { return !p.ipa.empty(); });
  if (silent) {
    return Status::Error("speech", "there is nothing to say in \"" + text + "\"");
  }
  if (collected.samples.size() > static_cast<size_t>(kMaxSynthesisSeconds * collected.rate)) {
    return Status::Error("speech", "the line lasts longer than five minutes", "split it");
  }
  spoken.samples = std::move(collected.samples);
  return spoken;
}

std::string SynthesizerCredits() {
  return std::string("eSpeak NG ") + espeak_Info(nullptr) + "; GPL-3.0-or-later";
}

}  // namespace lararium::bake
