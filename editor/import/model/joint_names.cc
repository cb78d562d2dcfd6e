#include "editor/import/model/joint_names.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <iterator>
#include <string>
#include <vector>

namespace lararium::import {
namespace {

struct Word {
  std::string_view text;
  BonePart part;
};

constexpr Word kMiddleWords[] = {
    {"hips", BonePart::kPelvis},
    {"hip", BonePart::kPelvis},
    {"pelvis", BonePart::kPelvis},
    {"humanoidroot", BonePart::kPelvis},
    {"sacroiliac", BonePart::kPelvis},
    {"spine", BonePart::kSpine},
    {"chest", BonePart::kSpine},
    {"upperchest", BonePart::kSpine},
    {"lowerback", BonePart::kSpine},
    {"torso", BonePart::kSpine},
    {"abdomen", BonePart::kSpine},
    {"ab", BonePart::kSpine},
    {"abdomenlower", BonePart::kSpine},
    {"abdomenupper", BonePart::kSpine},
    {"chestlower", BonePart::kSpine},
    {"chestupper", BonePart::kSpine},
    {"back", BonePart::kSpine},
    {"waist", BonePart::kSpine},
    {"vl", BonePart::kSpine},
    {"vt", BonePart::kSpine},
    {"neck", BonePart::kNeck},
    {"vc", BonePart::kNeck},
    {"necklower", BonePart::kNeck},
    {"neckupper", BonePart::kNeck},
    {"necktwist", BonePart::kNeck},
    {"head", BonePart::kHead},
    {"skullbase", BonePart::kHead},
    {"jaw", BonePart::kJaw},
    {"temporomandibular", BonePart::kJaw},
};

constexpr Word kPairedWords[] = {
    {"clavicle", BonePart::kClavicle},
    {"collar", BonePart::kClavicle},
    {"sternoclavicular", BonePart::kClavicle},
    {"acromioclavicular", BonePart::kClavicle},
    {"shoulder", BonePart::kShoulder},
    {"upperarm", BonePart::kUpperArm},
    {"uparm", BonePart::kUpperArm},
    {"arm", BonePart::kUpperArm},
    {"shldr", BonePart::kUpperArm},
    {"shldrbend", BonePart::kUpperArm},
    {"forearm", BonePart::kForearm},
    {"forearmbend", BonePart::kForearm},
    {"lowerarm", BonePart::kForearm},
    {"lowarm", BonePart::kForearm},
    {"elbow", BonePart::kForearm},
    {"hand", BonePart::kHand},
    {"wrist", BonePart::kHand},
    {"hip", BonePart::kHip},
    {"thigh", BonePart::kThigh},
    {"thighbend", BonePart::kThigh},
    {"upleg", BonePart::kThigh},
    {"upperleg", BonePart::kThigh},
    {"leg", BonePart::kLeg},
    {"shin", BonePart::kShin},
    {"calf", BonePart::kShin},
    {"lowerleg", BonePart::kShin},
    {"lowleg", BonePart::kShin},
    {"knee", BonePart::kShin},
    {"foot", BonePart::kFoot},
    {"ankle", BonePart::kFoot},
    {"toe", BonePart::kToes},
    {"toes", BonePart::kToes},
    {"toebase", BonePart::kToes},
    {"ball", BonePart::kToes},
    {"midtarsal", BonePart::kToes},
    {"metatarsals", BonePart::kToes},
    {"eye", BonePart::kEye},
    {"faceeye", BonePart::kEye},
    {"eyeball", BonePart::kEye},
    {"eyeballjoint", BonePart::kEye},
    {"thumb", BonePart::kThumb},
    {"handthumb", BonePart::kThumb},
    {"index", BonePart::kIndex},
    {"handindex", BonePart::kIndex},
    {"middle", BonePart::kMiddle},
    {"handmiddle", BonePart::kMiddle},
    {"mid", BonePart::kMiddle},
    {"ring", BonePart::kRing},
    {"handring", BonePart::kRing},
    {"pinky", BonePart::kLittle},
    {"handpinky", BonePart::kLittle},
    {"little", BonePart::kLittle},
    {"pinkie", BonePart::kLittle},
};

// Prefixes of rigs that have no meaning.
constexpr std::string_view kPrefixes[] = {"bip", "j", "def", "org", "cc",  "base", "bone", "jnt",
                                          "b",   "c", "f",   "adj", "rig", "sk",   "m"};

// Helpers that contain the name of the bone that they help.
constexpr std::string_view kHelpers[] = {
    "twist", "roll",   "ik",   "pole", "ctrl",   "control", "end",    "nub", "target", "sec",
    "mch",   "helper", "site", "fk",   "socket", "prop",    "weapon", "top", "dummy"};

constexpr std::string_view kFingerSegments[] = {"metacarpal", "proximal", "intermediate", "distal"};

struct Tokens {
  std::vector<std::string> words;
  std::vector<std::string> numbers;
};

enum class Kind { kLower, kUpper, kDigit, kOther };

Kind KindOf(char c) {
  const auto u = static_cast<unsigned char>(c);
  if (std::isdigit(u) != 0) {
    return Kind::kDigit;
  }
  if (std::isupper(u) != 0) {
    return Kind::kUpper;
  }
  return std::islower(u) != 0 ? Kind::kLower : Kind::kOther;
}

// Says whether a new word begins at i.
bool Breaks(std::string_view name, size_t i) {
  const Kind before = KindOf(name[i - 1]), here = KindOf(name[i]);
  if (before == here) {
    // "LHip": the last of several capitals begins a word if a lower-case letter follows.
    return here == Kind::kUpper && i + 1 < name.size() && KindOf(name[i + 1]) == Kind::kLower;
  }
  return !(before == Kind::kUpper && here == Kind::kLower);
}

Tokens Split(std::string_view name) {
  Tokens tokens;
  std::string token;
  const auto flush = [&] {
    if (token.empty()) {
      return;
    }
    (KindOf(token[0]) == Kind::kDigit ? tokens.numbers : tokens.words).push_back(token);
    token.clear();
  };
  for (size_t i = 0; i < name.size(); ++i) {
    if (i > 0 && Breaks(name, i)) {
      flush();
    }
    if (KindOf(name[i]) == Kind::kOther) {
      flush();
    } else {
      token += static_cast<char>(std::tolower(static_cast<unsigned char>(name[i])));
    }
  }
  flush();
  return tokens;
}

template <size_t N>
bool Contains(const std::string_view (&words)[N], std::string_view word) {
  return std::find(std::begin(words), std::end(words), word) != std::end(words);
}

BodySide TakeSide(std::vector<std::string>& words) {
  for (size_t i = 0; i < words.size(); ++i) {
    const bool left = words[i] == "l" || words[i] == "left" || words[i] == "lft";
    if (left || words[i] == "r" || words[i] == "right" || words[i] == "rgt") {
      words.erase(words.begin() + static_cast<std::ptrdiff_t>(i));
      return left ? BodySide::kLeft : BodySide::kRight;
    }
  }
  return BodySide::kMiddle;
}

// "leftarm", "rthigh": a side without a capital or separator after it.
BodySide TakeAttachedSide(std::string& bare) {
  for (const auto& [prefix, side] :
       {std::pair{"left", BodySide::kLeft}, std::pair{"right", BodySide::kRight},
        std::pair{"l", BodySide::kLeft}, std::pair{"r", BodySide::kRight}}) {
    const std::string rest =
        bare.starts_with(prefix) ? bare.substr(std::string_view(prefix).size()) : std::string();
    if (std::any_of(std::begin(kPairedWords), std::end(kPairedWords),
                    [&](const Word& word) { return word.text == rest; })) {
      bare = rest;
      return side;
    }
  }
  return BodySide::kMiddle;
}

template <size_t N>
BonePart Lookup(const Word (&words)[N], std::string_view bare) {
  for (const Word& word : words) {
    if (word.text == bare) {
      return word.part;
    }
  }
  return BonePart::kUnknown;
}

bool IsFinger(BonePart part) { return part >= BonePart::kThumb && part <= BonePart::kLittle; }

int NumberOf(const std::string& digits) {
  int value = 0;
  for (const char c : digits.substr(0, 6)) {
    value = 10 * value + (c - '0');
  }
  return value;
}

// Biped counts fingers from 0 and appends the segment ("Finger0", "Finger01", "Finger12");
// MakeHuman counts both from 1 ("finger1-1").
BoneName NumberedFinger(BodySide side, const std::vector<std::string>& numbers) {
  constexpr std::array kFingers = {BonePart::kThumb, BonePart::kIndex, BonePart::kMiddle,
                                   BonePart::kRing, BonePart::kLittle};
  if (numbers.empty() || numbers[0].size() > 2) {
    return {};
  }
  const bool makehuman = numbers.size() == 2;
  const int finger = makehuman ? NumberOf(numbers[0]) - 1 : numbers[0][0] - '0';
  const int segment = makehuman                ? NumberOf(numbers[1])
                      : numbers[0].size() == 2 ? numbers[0][1] - '0' + 1
                                               : 1;
  if (finger < 0 || finger > 4 || segment < 1 || segment > 3) {
    return {};
  }
  return {side, kFingers[static_cast<size_t>(finger)], segment};
}

// Removes the name of the rig: "mixamorig:", "Bip01 ", "Character1_".
std::string_view WithoutRig(std::string_view name) {
  if (const size_t space = name.rfind(':'); space != std::string_view::npos) {
    name.remove_prefix(space + 1);
  }
  for (const std::string_view rig : {"valvebiped.", "bip", "character"}) {
    const bool begins = name.size() > rig.size() &&
                        std::equal(rig.begin(), rig.end(), name.begin(), [](char a, char b) {
                          return a == std::tolower(static_cast<unsigned char>(b));
                        });
    if (begins) {
      name.remove_prefix(rig.size());
      while (!name.empty() && KindOf(name[0]) == Kind::kDigit) {
        name.remove_prefix(1);
      }
    }
  }
  return name;
}

}  // namespace

BoneName ParseBoneName(std::string_view name) {
  Tokens tokens = Split(WithoutRig(name).substr(0, 256));
  BodySide side = TakeSide(tokens.words);
  int segment = -1;
  std::string bare;
  for (const std::string& word : tokens.words) {
    if (Contains(kHelpers, word)) {
      return {};
    }
    const auto found = std::find(std::begin(kFingerSegments), std::end(kFingerSegments), word);
    if (found != std::end(kFingerSegments)) {
      segment = static_cast<int>(found - std::begin(kFingerSegments));
    } else if (!Contains(kPrefixes, word)) {
      bare += word;
    }
  }
  if (side == BodySide::kMiddle) {
    if (const BonePart part = Lookup(kMiddleWords, bare); part != BonePart::kUnknown) {
      return {side, part, 0};
    }
    side = TakeAttachedSide(bare);
    if (side == BodySide::kMiddle) {
      return {};
    }
  }
  if (bare == "finger") {
    return NumberedFinger(side, tokens.numbers);
  }
  const BonePart part = Lookup(kPairedWords, bare);
  if (part == BonePart::kUnknown) {
    return {};
  }
  if (IsFinger(part)) {
    if (segment < 0) {
      segment = tokens.numbers.empty() ? 1 : NumberOf(tokens.numbers.back());
    }
    return segment > 3 ? BoneName() : BoneName{side, part, segment};
  }
  return {side, part, 0};
}

}  // namespace lararium::import
