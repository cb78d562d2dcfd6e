#include "editor/import/wardrobe/garment_pattern.h"

#include <utility>

#include "shared/core/json_fields.h"
#include "shared/core/srgb.h"

namespace lararium::import {
namespace {

constexpr std::pair<const char*, GarmentKind> kKinds[] = {
    {"tunic", GarmentKind::kTunic}, {"stola", GarmentKind::kStola},
    {"apron", GarmentKind::kApron}, {"toga", GarmentKind::kToga},
    {"palla", GarmentKind::kPalla}, {"sandals", GarmentKind::kSandals}};

// Dyes and natural colours of wool and leather; sRGB.
constexpr std::pair<const char*, uint32_t> kDyes[] = {
    {"undyed", 0xd9cbb0},      {"white", 0xe9e4d6},  {"ochre", 0xb98a3e},  {"madder", 0x9c3f2c},
    {"rust", 0x8a4a2a},        {"woad", 0x4a6480},   {"indigo", 0x2e3f5c}, {"walnut", 0x6a4c33},
    {"brown", 0x7d634a},       {"grey", 0x8d857a},   {"black", 0x37312d},  {"weld", 0xc9ab4c},
    {"green", 0x6b7146},       {"purple", 0x5a2440}, {"rose", 0xb4796c},   {"leather", 0x5c3a22},
    {"dark leather", 0x3a2618}};

constexpr std::pair<const char*, float> kLengths[] = {
    {"thigh", 0.6f}, {"knee", 1.02f}, {"calf", 1.45f}, {"ankle", 1.8f}, {"floor", 1.95f}};
constexpr std::pair<const char*, Sleeve> kSleeves[] = {
    {"none", Sleeve::kNone}, {"short", Sleeve::kShort}, {"elbow", Sleeve::kElbow}};
constexpr std::pair<const char*, Stripes> kStripes[] = {
    {"none", Stripes::kNone}, {"narrow", Stripes::kNarrow}, {"broad", Stripes::kBroad}};
constexpr std::pair<const char*, Belt> kBelts[] = {
    {"none", Belt::kNone}, {"cord", Belt::kCord}, {"leather", Belt::kLeather}};

template <typename Value, size_t kCount>
std::vector<std::string> WordsOf(const std::pair<const char*, Value> (&words)[kCount]) {
  std::vector<std::string> names;
  for (const auto& [name, unused] : words) {
    names.emplace_back(name);
  }
  return names;
}

glm::vec3 ToLinear(uint32_t rgb) {
  glm::vec3 colour;
  for (int k = 0; k < 3; ++k) {
    colour[k] = LinearFromSrgb(static_cast<float>(rgb >> (16 - 8 * k) & 0xffu) / 255.0f);
  }
  return colour;
}

// The default of each kind of garment.
GarmentPattern PlainPattern(GarmentKind kind) {
  GarmentPattern pattern;
  pattern.kind = kind;
  pattern.stripe_colour = ToLinear(0x5a2440);
  pattern.belt_colour = ToLinear(0x5c3a22);
  pattern.colour = ToLinear(0xd9cbb0);
  switch (kind) {
    case GarmentKind::kTunic:
      break;
    case GarmentKind::kStola:
      pattern.hem = 1.95f;
      pattern.sleeve = Sleeve::kElbow;
      pattern.ease = 1.8f;
      pattern.belt = Belt::kCord;
      pattern.blouse = 0.03f;
      break;
    case GarmentKind::kApron:
      pattern.hem = 0.9f;
      pattern.colour = ToLinear(0x9a8e7c);
      pattern.belt = Belt::kCord;
      break;
    case GarmentKind::kToga:
      pattern.hem = 1.82f;
      pattern.colour = ToLinear(0xe9e4d6);
      pattern.belt = Belt::kNone;
      break;
    case GarmentKind::kPalla:
      pattern.hem = 1.3f;
      pattern.belt = Belt::kNone;
      break;
    case GarmentKind::kSandals:
      pattern.colour = ToLinear(0x5c3a22);
      pattern.belt = Belt::kNone;
      break;
  }
  return pattern;
}

// Describes one of the words, for reading. `what` and `remedy` are parts of the error about another
// word.
template <typename Value, size_t kCount>
void DescribeWord(Fields& fields,
                  const FieldKey& key,
                  const std::pair<const char*, Value> (&words)[kCount],
                  Value& value,
                  const std::string& what = "",
                  const std::string& remedy = "choose") {
  if (!key.required && !fields.Has(key.name)) {
    return;
  }
  std::string word;
  std::string known;
  fields.Text(key, word, 100);
  for (const auto& [name, named] : words) {
    if (word == name) {
      value = named;
      return;
    }
    known += (known.empty() ? "" : ", ") + std::string(name);
  }
  fields.RequireAt(key, false, "there is no " + what + "'" + word.substr(0, 40) + "'",
                   remedy + " one of: " + known);
}

// Describes the name of a dye ("madder") or "#rrggbb" as linear RGB, for reading.
void DescribeDye(Fields& fields, const char* key, glm::vec3& colour) {
  if (!fields.Has(key)) {
    return;
  }
  std::string text;
  uint32_t rgb = 0;
  fields.Text(key, text, 100);
  if (text.size() == 7 && text[0] == '#' &&
      text.find_first_not_of("0123456789abcdefABCDEF", 1) == std::string::npos) {
    rgb = static_cast<uint32_t>(std::stoul(text.substr(1), nullptr, 16));
  } else {
    DescribeWord(fields, key, kDyes, rgb, "dye ", "write #rrggbb or");
  }
  colour = ToLinear(rgb);
}

}  // namespace

std::vector<std::string> GarmentNames() { return WordsOf(kKinds); }

std::vector<std::string> GarmentWords(std::string_view field) {
  if (field == "length") return WordsOf(kLengths);
  if (field == "sleeve") return WordsOf(kSleeves);
  if (field == "belt") return WordsOf(kBelts);
  if (field == "stripes") return WordsOf(kStripes);
  return WordsOf(kDyes);
}

std::string NameOf(GarmentKind kind) {
  for (const auto& [name, value] : kKinds) {
    if (value == kind) {
      return name;
    }
  }
  return "";
}

void DescribeFields(Fields& fields, GarmentPattern& pattern) {
  DescribeWord(fields, "name", kKinds, pattern.kind);
  pattern = PlainPattern(pattern.kind);
  if (fields.IsText("length")) {
    DescribeWord(fields, "length", kLengths, pattern.hem);
  } else {
    fields.Number(Optional("length"), pattern.hem, 0.3, 2.0);
  }
  DescribeWord(fields, Optional("sleeve"), kSleeves, pattern.sleeve);
  DescribeWord(fields, Optional("belt"), kBelts, pattern.belt);
  DescribeWord(fields, Optional("stripes"), kStripes, pattern.stripes);
  fields.Flag(Optional("one_shoulder"), pattern.one_shoulder);
  fields.Flag(Optional("border"), pattern.border);
  fields.Number(Optional("ease"), pattern.ease, 1.1, 2.5);
  fields.Number(Optional("blouse"), pattern.blouse, 0.0, 0.15);
  fields.Number(Optional("wear"), pattern.wear, 0.0, 1.0);
  DescribeDye(fields, "colour", pattern.colour);
  DescribeDye(fields, "belt_colour", pattern.belt_colour);
  DescribeDye(fields, "stripe_colour", pattern.stripe_colour);
  fields.Integer(Optional("seed"), pattern.seed, 0, 1'000'000'000);
}

}  // namespace lararium::import
