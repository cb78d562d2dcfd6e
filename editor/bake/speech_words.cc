#include "editor/bake/speech_words.h"

#include <pocketsphinx.h>
#include <sphinxbase/err.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "editor/bake/speech_features.h"
#include "shared/core/lower_case.h"

namespace lararium::bake {
namespace {

constexpr int kRate = 16000;              // Sample rate of the model.
constexpr double kFramesPerSecond = 100;  // Frame rate of the model.

// English sounds as espeak-ng writes them, and the model's names; longer symbols first.
constexpr std::array<std::pair<std::string_view, std::string_view>, 52> kPhones = {{
    {"tʃ", "CH"}, {"dʒ", "JH"}, {"aɪ", "AY"},   {"aʊ", "AW"},   {"eɪ", "EY"},   {"ɔɪ", "OY"},
    {"oʊ", "OW"}, {"əʊ", "OW"}, {"iə", "IY R"}, {"eə", "EH R"}, {"ʊə", "UH R"}, {"iː", "IY"},
    {"uː", "UW"}, {"ɑː", "AA"}, {"ɔː", "AO"},   {"ɜː", "ER"},   {"p", "P"},     {"b", "B"},
    {"t", "T"},   {"d", "D"},   {"k", "K"},     {"ɡ", "G"},     {"g", "G"},     {"f", "F"},
    {"v", "V"},   {"θ", "TH"},  {"ð", "DH"},    {"s", "S"},     {"z", "Z"},     {"ʃ", "SH"},
    {"ʒ", "ZH"},  {"h", "HH"},  {"m", "M"},     {"n", "N"},     {"ŋ", "NG"},    {"l", "L"},
    {"ɹ", "R"},   {"r", "R"},   {"w", "W"},     {"j", "Y"},     {"i", "IY"},    {"ɪ", "IH"},
    {"e", "EH"},  {"ɛ", "EH"},  {"a", "AE"},    {"æ", "AE"},    {"ʌ", "AH"},    {"ɐ", "AH"},
    {"ə", "AH"},  {"ɒ", "AA"},  {"ʊ", "UH"},    {"ɚ", "ER"},
}};

std::string PhonesOf(std::string_view ipa) {
  std::string phones;
  while (!ipa.empty()) {
    const auto found = std::find_if(kPhones.begin(), kPhones.end(), [ipa](const auto& entry) {
      return ipa.starts_with(entry.first);
    });
    if (found == kPhones.end()) {
      ipa.remove_prefix(1);  // a byte of a mark
      continue;
    }
    phones += (phones.empty() ? "" : " ") + std::string(found->second);
    ipa.remove_prefix(found->first.size());
  }
  return phones;
}

// Pronunciation of a word according to espeak-ng.
std::string SpokenPhones(const SpokenText& reference, int word) {
  std::string phones;
  for (const Phoneme& phoneme : reference.phonemes) {
    if (phoneme.word == word) {
      const std::string of_phoneme = PhonesOf(phoneme.ipa);
      phones += (phones.empty() || of_phoneme.empty() ? "" : " ") + of_phoneme;
    }
  }
  return phones;
}

// Owns a pocketsphinx decoder without log output.
class Decoder {
 public:
  Decoder() {
    err_set_logfp(nullptr);
    const std::string model = LARARIUM_SPHINX_MODELS "/en-us";
    config_.reset(cmd_ln_init(nullptr, ps_args(), 1, "-hmm", (model + "/en-us").c_str(), "-dict",
                              (model + "/cmudict-en-us.dict").c_str(), "-dither", "no", nullptr));
    if (config_ != nullptr) {
      decoder_.reset(ps_init(config_.get()));
    }
  }

  bool ok() const { return decoder_ != nullptr; }
  ps_decoder_t* get() { return decoder_.get(); }

  // Each word of the sentence is named "w" and its index, so that none is found twice.
  bool AddWord(const SpokenText& reference, size_t index) {
    std::string phones;
    if (char* known = ps_lookup_word(get(), LowerCase(reference.words[index]).c_str())) {
      phones = known;
      std::free(known);
    } else {
      phones = SpokenPhones(reference, static_cast<int>(index));
    }
    return !phones.empty() &&
           ps_add_word(get(), ("w" + std::to_string(index)).c_str(), phones.c_str(), 0) >= 0;
  }

 private:
  struct FreeConfig {
    void operator()(cmd_ln_t* config) const { cmd_ln_free_r(config); }
  };
  struct FreeDecoder {
    void operator()(ps_decoder_t* decoder) const { ps_free(decoder); }
  };
  std::unique_ptr<cmd_ln_t, FreeConfig> config_;
  std::unique_ptr<ps_decoder_t, FreeDecoder> decoder_;
};

std::vector<int16> Samples(const Sound& recording) {
  std::vector<int16> samples;
  for (const float sample : Resample(recording.samples, recording.rate, kRate)) {
    samples.push_back(static_cast<int16>(std::lround(std::clamp(sample, -1.0f, 1.0f) * 32767.0f)));
  }
  return samples;
}

}  // namespace

Result<WordTimes> FindEnglishWords(const Sound& recording, const SpokenText& reference) {
  Decoder decoder;
  if (!decoder.ok()) {
    return Status::Error("pocketsphinx", "its English model cannot be opened",
                         "install pocketsphinx-en-us");
  }
  std::string grammar = "#JSGF V1.0;\ngrammar line;\npublic <line> =";
  for (size_t i = 0; i < reference.words.size(); ++i) {
    // The times of words that espeak-ng joins with the next one stay unknown.
    if (decoder.AddWord(reference, i)) {
      grammar += " w" + std::to_string(i);
    }
  }
  grammar += ";\n";
  if (ps_set_jsgf_string(decoder.get(), "line", grammar.c_str()) < 0 ||
      ps_set_search(decoder.get(), "line") < 0) {
    return Status::Error("pocketsphinx", "cannot make a grammar of the line");
  }
  const std::vector<int16> samples = Samples(recording);
  const bool heard = ps_start_utt(decoder.get()) >= 0 &&
                     ps_process_raw(decoder.get(), samples.data(), samples.size(), 0, 1) >= 0 &&
                     ps_end_utt(decoder.get()) >= 0;
  WordTimes times(reference.words.size());
  size_t found = 0;
  for (ps_seg_t* segment = heard ? ps_seg_iter(decoder.get()) : nullptr; segment != nullptr;
       segment = ps_seg_next(segment)) {
    const std::string_view word = ps_seg_word(segment);
    int begin = 0, end = 0;
    ps_seg_frames(segment, &begin, &end);
    const bool is_ours = word.size() > 1 && word[0] == 'w' && word[1] >= '0' && word[1] <= '9';
    const size_t index = is_ours ? std::strtoul(word.data() + 1, nullptr, 10) : times.size();
    if (index < times.size()) {
      times[index] = begin / kFramesPerSecond;
      ++found;
    }
  }
  if (found == 0) {
    return Status::Error("pocketsphinx", "does not recognise the line in its recording");
  }
  return times;
}

}  // namespace lararium::bake
