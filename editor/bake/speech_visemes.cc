#include "editor/bake/speech_visemes.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

namespace lararium::bake {
namespace {

using human::Viseme;

// The mouth shape of an IPA symbol.
struct Shape {
  std::string_view ipa;
  Viseme viseme;
  float strength;
  bool vowel;
};

// Longer symbols first, because the first match is taken.
constexpr std::array kShapes = {
    Shape{"tʃ", Viseme::kCH, 1.0f, false}, Shape{"dʒ", Viseme::kCH, 1.0f, false},
    Shape{"ts", Viseme::kSS, 1.0f, false}, Shape{"dz", Viseme::kSS, 1.0f, false},
    Shape{"pf", Viseme::kFF, 1.0f, false}, Shape{"p", Viseme::kPP, 1.0f, false},
    Shape{"b", Viseme::kPP, 1.0f, false},  Shape{"m", Viseme::kPP, 1.0f, false},
    Shape{"f", Viseme::kFF, 1.0f, false},  Shape{"v", Viseme::kFF, 1.0f, false},
    Shape{"ɱ", Viseme::kFF, 1.0f, false},  Shape{"ʋ", Viseme::kFF, 0.7f, false},
    Shape{"β", Viseme::kPP, 0.7f, false},  Shape{"ɸ", Viseme::kFF, 0.8f, false},
    Shape{"θ", Viseme::kTH, 1.0f, false},  Shape{"ð", Viseme::kTH, 1.0f, false},
    Shape{"t", Viseme::kDD, 0.9f, false},  Shape{"d", Viseme::kDD, 0.9f, false},
    Shape{"ʈ", Viseme::kDD, 0.9f, false},  Shape{"ɖ", Viseme::kDD, 0.9f, false},
    Shape{"k", Viseme::kKk, 0.9f, false},  Shape{"ɡ", Viseme::kKk, 0.9f, false},
    Shape{"g", Viseme::kKk, 0.9f, false},  Shape{"q", Viseme::kKk, 0.9f, false},
    Shape{"ŋ", Viseme::kKk, 0.8f, false},  Shape{"x", Viseme::kKk, 0.8f, false},
    Shape{"ɣ", Viseme::kKk, 0.8f, false},  Shape{"χ", Viseme::kKk, 0.8f, false},
    Shape{"c", Viseme::kKk, 0.9f, false},  Shape{"ɟ", Viseme::kKk, 0.9f, false},
    Shape{"ʃ", Viseme::kCH, 1.0f, false},  Shape{"ʒ", Viseme::kCH, 1.0f, false},
    Shape{"ɕ", Viseme::kCH, 1.0f, false},  Shape{"ç", Viseme::kCH, 0.7f, false},
    Shape{"s", Viseme::kSS, 0.9f, false},  Shape{"z", Viseme::kSS, 0.9f, false},
    Shape{"n", Viseme::kNn, 0.9f, false},  Shape{"ɲ", Viseme::kNn, 0.9f, false},
    Shape{"l", Viseme::kNn, 0.9f, false},  Shape{"ɫ", Viseme::kNn, 0.9f, false},
    Shape{"ʎ", Viseme::kNn, 0.9f, false},  Shape{"r", Viseme::kRR, 0.9f, false},
    Shape{"ɹ", Viseme::kRR, 0.9f, false},  Shape{"ɾ", Viseme::kRR, 0.8f, false},
    Shape{"ʁ", Viseme::kRR, 0.8f, false},  Shape{"ʀ", Viseme::kRR, 0.8f, false},
    Shape{"w", Viseme::kOu, 1.0f, false},  Shape{"ʍ", Viseme::kOu, 1.0f, false},
    Shape{"ɥ", Viseme::kOu, 0.9f, false},  Shape{"j", Viseme::kIh, 0.8f, false},
    Shape{"a", Viseme::kAa, 1.0f, true},   Shape{"ɑ", Viseme::kAa, 1.0f, true},
    Shape{"ɐ", Viseme::kAa, 0.8f, true},   Shape{"ʌ", Viseme::kAa, 0.9f, true},
    Shape{"æ", Viseme::kAa, 0.9f, true},   Shape{"ɒ", Viseme::kOh, 0.9f, true},
    Shape{"e", Viseme::kE, 1.0f, true},    Shape{"ɛ", Viseme::kE, 1.0f, true},
    Shape{"ɜ", Viseme::kE, 0.8f, true},    Shape{"ə", Viseme::kE, 0.6f, true},
    Shape{"ɚ", Viseme::kRR, 0.8f, true},   Shape{"ɘ", Viseme::kE, 0.7f, true},
    Shape{"i", Viseme::kIh, 1.0f, true},   Shape{"ɪ", Viseme::kIh, 0.9f, true},
    Shape{"ᵻ", Viseme::kIh, 0.7f, true},   Shape{"ɨ", Viseme::kIh, 0.8f, true},
    Shape{"y", Viseme::kOu, 0.9f, true},   Shape{"ʏ", Viseme::kOu, 0.8f, true},
    Shape{"o", Viseme::kOh, 1.0f, true},   Shape{"ɔ", Viseme::kOh, 1.0f, true},
    Shape{"ø", Viseme::kOh, 0.8f, true},   Shape{"œ", Viseme::kOh, 0.8f, true},
    Shape{"u", Viseme::kOu, 1.0f, true},   Shape{"ʊ", Viseme::kOu, 0.9f, true},
    Shape{"ɯ", Viseme::kIh, 0.7f, true},
};

constexpr Shape kUnknown = {"", Viseme::kE, 0.5f, true};

// The visible symbols of one sound: "eː" is one, "aɪ" two. Marks of length, stress and
// secondary articulation have no shape.
std::vector<Shape> ShapesOf(std::string_view ipa) {
  std::vector<Shape> shapes;
  size_t at = 0;
  while (at < ipa.size()) {
    const std::string_view rest = ipa.substr(at);
    const auto found = std::find_if(kShapes.begin(), kShapes.end(), [rest](const Shape& shape) {
      return rest.starts_with(shape.ipa);
    });
    if (found != kShapes.end()) {
      shapes.push_back(*found);
      at += found->ipa.size();
    } else {
      ++at;  // A byte of a mark.
    }
  }
  return shapes;
}

// Says whether the sound is a breath that takes the shape of the next vowel.
bool IsBreath(std::string_view ipa) { return ipa == "h" || ipa == "ɦ" || ipa == "ʔ" || ipa == "ʰ"; }

Shape NextVowel(std::span<const Phoneme> following) {
  for (const Phoneme& phoneme : following) {
    for (const Shape& shape : ShapesOf(phoneme.ipa)) {
      if (shape.vowel) {
        return shape;
      }
    }
  }
  return kUnknown;
}

void AddKey(double time, Viseme viseme, float strength, human::VisemeTrack& track) {
  if (!track.keys.empty() && track.keys.back().viseme == viseme) {
    track.keys.back().strength = std::max(track.keys.back().strength, strength);
    return;
  }
  track.keys.push_back({static_cast<float>(time), viseme, strength});
}

}  // namespace

human::VisemeTrack VisemesOf(std::span<const Phoneme> phonemes, double duration) {
  human::VisemeTrack track;
  track.duration = static_cast<float>(duration);
  for (size_t i = 0; i < phonemes.size(); ++i) {
    const Phoneme& phoneme = phonemes[i];
    if (phoneme.ipa.empty()) {
      AddKey(phoneme.begin, Viseme::kSil, 1.0f, track);
      continue;
    }
    if (IsBreath(phoneme.ipa)) {
      const Shape vowel = NextVowel(phonemes.subspan(i + 1));
      AddKey(phoneme.begin, vowel.viseme, 0.6f * vowel.strength, track);
      continue;
    }
    std::vector<Shape> shapes = ShapesOf(phoneme.ipa);
    if (shapes.empty()) {
      shapes.push_back(kUnknown);
    }
    const double length = (phoneme.end - phoneme.begin) / static_cast<double>(shapes.size());
    for (size_t k = 0; k < shapes.size(); ++k) {
      AddKey(phoneme.begin + static_cast<double>(k) * length, shapes[k].viseme, shapes[k].strength,
             track);
    }
  }
  return track;
}

}  // namespace lararium::bake
