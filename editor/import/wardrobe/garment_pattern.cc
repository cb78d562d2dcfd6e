#include "editor/import/wardrobe/garment_pattern.h"

#include <optional>
#include <utility>

#include "shared/core/json.h"
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
Result<Value> OneOf(const JsonView& field, const std::pair<const char*, Value> (&words)[kCount]) {
  LARARIUM_ASSIGN_OR_RETURN(const std::string word, field.Text(100));
  std::string known;
  for (const auto& [name, value] : words) {
    if (word == name) {
      return value;
    }
    known += (known.empty() ? "" : ", ") + std::string(name);
  }
  return field.Problem("there is no '" + word.substr(0, 40) + "'", "choose one of: " + known);
}

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

std::optional<uint32_t> HexColour(const std::string& text) {
  if (text.size() != 7 || text[0] != '#' ||
      text.find_first_not_of("0123456789abcdefABCDEF", 1) != std::string::npos) {
    return std::nullopt;
  }
  return static_cast<uint32_t>(std::stoul(text.substr(1), nullptr, 16));
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

// Reads a word, or metres above the floor, as a share of the leg.
Status ReadLength(const JsonView& garment, GarmentPattern& pattern) {
  if (!garment.Has("length")) {
    return Status();
  }
  LARARIUM_ASSIGN_OR_RETURN(const JsonView field, garment.Field("length"));
  if (field.json().is_string()) {
    LARARIUM_ASSIGN_OR_RETURN(pattern.hem, OneOf(field, kLengths));
    return Status();
  }
  LARARIUM_ASSIGN_OR_RETURN(const double hem, field.Number(0.3, 2.0));
  pattern.hem = static_cast<float>(hem);
  return Status();
}

Status ReadNumber(const JsonView& garment, const char* key, double min, double max, float& value) {
  if (garment.Has(key)) {
    LARARIUM_ASSIGN_OR_RETURN(const double number, garment.Number(key, min, max));
    value = static_cast<float>(number);
  }
  return Status();
}

Status ReadColour(const JsonView& garment, const char* key, glm::vec3& colour) {
  if (garment.Has(key)) {
    LARARIUM_ASSIGN_OR_RETURN(const JsonView field, garment.Field(key));
    LARARIUM_ASSIGN_OR_RETURN(colour, ParseDye(field));
  }
  return Status();
}

template <typename Value, size_t kCount>
Status ReadWord(const JsonView& garment,
                const char* key,
                const std::pair<const char*, Value> (&words)[kCount],
                Value& value) {
  if (garment.Has(key)) {
    LARARIUM_ASSIGN_OR_RETURN(const JsonView field, garment.Field(key));
    LARARIUM_ASSIGN_OR_RETURN(value, OneOf(field, words));
  }
  return Status();
}

Status ReadFlag(const JsonView& garment, const char* key, bool& value) {
  if (garment.Has(key)) {
    LARARIUM_ASSIGN_OR_RETURN(const JsonView field, garment.Field(key));
    LARARIUM_ASSIGN_OR_RETURN(value, field.Boolean());
  }
  return Status();
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

Result<glm::vec3> ParseDye(const JsonView& field) {
  LARARIUM_ASSIGN_OR_RETURN(const std::string text, field.Text(100));
  if (const std::optional<uint32_t> hex = HexColour(text); hex) {
    return ToLinear(*hex);
  }
  std::string known;
  for (const auto& [name, rgb] : kDyes) {
    if (text == name) {
      return ToLinear(rgb);
    }
    known += (known.empty() ? "" : ", ") + std::string(name);
  }
  return field.Problem("there is no dye '" + text.substr(0, 40) + "'",
                       "write #rrggbb or one of: " + known);
}

Result<GarmentPattern> ParseGarmentPattern(const JsonView& garment) {
  LARARIUM_RETURN_IF_ERROR(garment.CheckFields(
      {"name", "length", "sleeve", "one_shoulder", "ease", "belt", "blouse", "colour",
       "belt_colour", "stripes", "stripe_colour", "border", "wear", "seed"}));
  LARARIUM_ASSIGN_OR_RETURN(const JsonView name, garment.Field("name"));
  LARARIUM_ASSIGN_OR_RETURN(const GarmentKind kind, OneOf(name, kKinds));
  GarmentPattern pattern = PlainPattern(kind);
  LARARIUM_RETURN_IF_ERROR(ReadLength(garment, pattern));
  LARARIUM_RETURN_IF_ERROR(ReadWord(garment, "sleeve", kSleeves, pattern.sleeve));
  LARARIUM_RETURN_IF_ERROR(ReadWord(garment, "belt", kBelts, pattern.belt));
  LARARIUM_RETURN_IF_ERROR(ReadWord(garment, "stripes", kStripes, pattern.stripes));
  LARARIUM_RETURN_IF_ERROR(ReadFlag(garment, "one_shoulder", pattern.one_shoulder));
  LARARIUM_RETURN_IF_ERROR(ReadFlag(garment, "border", pattern.border));
  LARARIUM_RETURN_IF_ERROR(ReadNumber(garment, "ease", 1.1, 2.5, pattern.ease));
  LARARIUM_RETURN_IF_ERROR(ReadNumber(garment, "blouse", 0.0, 0.15, pattern.blouse));
  LARARIUM_RETURN_IF_ERROR(ReadNumber(garment, "wear", 0.0, 1.0, pattern.wear));
  LARARIUM_RETURN_IF_ERROR(ReadColour(garment, "colour", pattern.colour));
  LARARIUM_RETURN_IF_ERROR(ReadColour(garment, "belt_colour", pattern.belt_colour));
  LARARIUM_RETURN_IF_ERROR(ReadColour(garment, "stripe_colour", pattern.stripe_colour));
  if (garment.Has("seed")) {
    LARARIUM_ASSIGN_OR_RETURN(const int64_t seed, garment.Integer("seed", 0, 1'000'000'000));
    pattern.seed = static_cast<uint64_t>(seed);
  }
  return pattern;
}

}  // namespace lararium::import
