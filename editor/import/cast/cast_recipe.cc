#include "editor/import/cast/cast_recipe.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <string_view>

namespace lararium::import {
namespace {

constexpr int kSchema = 1;
constexpr std::string_view kFields[] = {
    "schema",      "name",        "sex",  "age",       "height",         "weight",
    "muscle",      "ethnicity",   "skin", "eyes",      "eyebrows",       "eyelashes",
    "teeth",       "tongue",      "hair", "beard",     "garments",       "modifiers",
    "proportions", "breast_size", "seed", "asymmetry", "breast_firmness"};
constexpr std::array<std::string_view, 3> kEthnicities = {"caucasian", "african", "asian"};

template <size_t N>
Status OnlyFields(const JsonView& object, const std::string_view (&known)[N]) {
  if (!object.json().is_object()) {
    return object.Problem("must be an object");
  }
  for (const auto& [key, unused] : object.json().items()) {
    if (std::find(std::begin(known), std::end(known), key) == std::end(known)) {
      std::string list;
      for (const std::string_view name : known) {
        list += (list.empty() ? "" : ", ") + std::string(name);
      }
      return object.Problem("there is no field \"" + key + "\"", "fields are: " + list);
    }
  }
  return Status();
}

Status ReadNumber(
    const JsonView& object, std::string_view key, double min, double max, float& value) {
  if (object.Has(key)) {
    LARARIUM_ASSIGN_OR_RETURN(const double number, object.Number(key, min, max));
    value = static_cast<float>(number);
  }
  return Status();
}

Status ReadText(const JsonView& object, std::string_view key, std::string& value) {
  if (object.Has(key)) {
    LARARIUM_ASSIGN_OR_RETURN(value, object.Text(key, 200));
  }
  return Status();
}

int HexDigit(char c) {
  if (c >= '0' && c <= '9') {
    return c - '0';
  }
  if (c >= 'a' && c <= 'f') {
    return c - 'a' + 10;
  }
  return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

Status ReadColour(const JsonView& object, std::string_view key, std::optional<glm::vec3>& colour) {
  if (!object.Has(key)) {
    return Status();
  }
  LARARIUM_ASSIGN_OR_RETURN(const JsonView field, object.Field(key));
  LARARIUM_ASSIGN_OR_RETURN(const std::string text, field.Text(20));
  bool valid = text.size() == 7 && text[0] == '#';
  glm::vec3 value(0.0f);
  for (int channel = 0; valid && channel < 3; ++channel) {
    const int high = HexDigit(text[1 + 2 * channel]);
    const int low = HexDigit(text[2 + 2 * channel]);
    valid = high >= 0 && low >= 0;
    value[channel] = static_cast<float>(16 * high + low) / 255.0f;
  }
  if (!valid) {
    return field.Problem("'" + text + "' is not a colour", "write it as \"#rrggbb\"");
  }
  colour = value;
  return Status();
}

std::string ColourText(const glm::vec3& colour) {
  std::string text = "#";
  for (int channel = 0; channel < 3; ++channel) {
    const int value = static_cast<int>(std::lround(colour[channel] * 255.0f));
    text += "0123456789abcdef"[value / 16];
    text += "0123456789abcdef"[value % 16];
  }
  return text;
}

// "name" or {"name": ..., "colour": ...}.
Status ReadDyed(const JsonView& field, CastDyed& dyed) {
  if (field.json().is_string()) {
    LARARIUM_ASSIGN_OR_RETURN(dyed.name, field.Text(200));
    return Status();
  }
  constexpr std::string_view kKnown[] = {"name", "colour", "volume", "tilt_deg"};
  LARARIUM_RETURN_IF_ERROR(OnlyFields(field, kKnown));
  LARARIUM_ASSIGN_OR_RETURN(dyed.name, field.Text("name", 200));
  LARARIUM_RETURN_IF_ERROR(ReadNumber(field, "volume", 0.1, 2.0, dyed.volume));
  float degrees = 0.0f;
  LARARIUM_RETURN_IF_ERROR(ReadNumber(field, "tilt_deg", -45.0, 45.0, degrees));
  dyed.tilt = glm::radians(degrees);
  return ReadColour(field, "colour", dyed.colour);
}

Json DyedJson(const CastDyed& dyed) {
  Json json = {{"name", dyed.name}, {"volume", dyed.volume}, {"tilt_deg", glm::degrees(dyed.tilt)}};
  if (dyed.colour) {
    json["colour"] = ColourText(*dyed.colour);
  }
  return json;
}

Status ReadSex(const JsonView& root, CastRecipe& recipe) {
  if (!root.Has("sex")) {
    return Status();
  }
  LARARIUM_ASSIGN_OR_RETURN(const JsonView field, root.Field("sex"));
  if (field.json().is_string()) {
    LARARIUM_ASSIGN_OR_RETURN(const std::string text, field.Text(20));
    if (text != "female" && text != "male") {
      return field.Problem("must be \"female\", \"male\" or a number from 0 to 1");
    }
    recipe.sex = text == "male" ? 1.0f : 0.0f;
    return Status();
  }
  return ReadNumber(root, "sex", 0.0, 1.0, recipe.sex);
}

Status ReadEthnicity(const JsonView& root, CastRecipe& recipe) {
  if (!root.Has("ethnicity")) {
    return Status();
  }
  LARARIUM_ASSIGN_OR_RETURN(const JsonView field, root.Field("ethnicity"));
  constexpr std::string_view kKnown[] = {"caucasian", "african", "asian"};
  LARARIUM_RETURN_IF_ERROR(OnlyFields(field, kKnown));
  recipe.ethnicity = glm::vec3(0.0f);
  for (int i = 0; i < 3; ++i) {
    LARARIUM_RETURN_IF_ERROR(ReadNumber(field, kEthnicities[i], 0.0, 1.0, recipe.ethnicity[i]));
  }
  if (recipe.ethnicity.x + recipe.ethnicity.y + recipe.ethnicity.z <= 0.0f) {
    return field.Problem("one share must be above 0");
  }
  return Status();
}

Status ReadModifiers(const JsonView& root, CastRecipe& recipe) {
  if (!root.Has("modifiers")) {
    return Status();
  }
  LARARIUM_ASSIGN_OR_RETURN(const JsonView field, root.Field("modifiers"));
  if (!field.json().is_object() || field.json().size() > 1000) {
    return field.Problem("must be an object of at most 1000 sliders");
  }
  for (const auto& [key, unused] : field.json().items()) {
    LARARIUM_ASSIGN_OR_RETURN(const double value, field.Number(key, -2.0, 2.0));
    recipe.modifiers[key] = static_cast<float>(value);
  }
  return Status();
}

Status ReadSkin(const JsonView& root, CastRecipe& recipe) {
  if (!root.Has("skin")) {
    return Status();
  }
  LARARIUM_ASSIGN_OR_RETURN(const JsonView field, root.Field("skin"));
  constexpr std::string_view kKnown[] = {"name",       "tint",     "stubble",
                                         "weathering", "freckles", "sunburn"};
  LARARIUM_RETURN_IF_ERROR(OnlyFields(field, kKnown));
  LARARIUM_RETURN_IF_ERROR(ReadText(field, "name", recipe.skin));
  LARARIUM_RETURN_IF_ERROR(ReadColour(field, "tint", recipe.skin_tint));
  LARARIUM_RETURN_IF_ERROR(ReadNumber(field, "stubble", 0.0, 1.0, recipe.stubble));
  LARARIUM_RETURN_IF_ERROR(ReadNumber(field, "weathering", 0.0, 1.0, recipe.weathering));
  LARARIUM_RETURN_IF_ERROR(ReadNumber(field, "freckles", 0.0, 1.0, recipe.freckles));
  return ReadNumber(field, "sunburn", 0.0, 1.0, recipe.sunburn);
}

Status ReadDyedParts(const JsonView& root, CastRecipe& recipe) {
  if (root.Has("eyes")) {
    LARARIUM_ASSIGN_OR_RETURN(const JsonView field, root.Field("eyes"));
    LARARIUM_RETURN_IF_ERROR(ReadDyed(field, recipe.eyes));
  }
  if (root.Has("eyebrows")) {
    LARARIUM_ASSIGN_OR_RETURN(const JsonView field, root.Field("eyebrows"));
    LARARIUM_RETURN_IF_ERROR(ReadDyed(field, recipe.eyebrows));
  }
  if (root.Has("hair")) {
    LARARIUM_ASSIGN_OR_RETURN(const JsonView field, root.Field("hair"));
    recipe.hair.emplace();
    LARARIUM_RETURN_IF_ERROR(ReadDyed(field, *recipe.hair));
  }
  if (!root.Has("beard")) {
    return Status();
  }
  LARARIUM_ASSIGN_OR_RETURN(const JsonView field, root.Field("beard"));
  LARARIUM_ASSIGN_OR_RETURN(const std::vector<JsonView> parts, field.Array(4));
  for (const JsonView& part : parts) {
    LARARIUM_RETURN_IF_ERROR(ReadDyed(part, recipe.beard.emplace_back()));
  }
  return Status();
}

Status ReadGarments(const JsonView& root, CastRecipe& recipe) {
  if (!root.Has("garments")) {
    return Status();
  }
  LARARIUM_ASSIGN_OR_RETURN(const JsonView field, root.Field("garments"));
  LARARIUM_ASSIGN_OR_RETURN(const std::vector<JsonView> garments, field.Array(16));
  for (const JsonView& garment : garments) {
    LARARIUM_RETURN_IF_ERROR(garment.Text("name", 200).status());
    recipe.garments.push_back(garment.json());
  }
  return Status();
}

}  // namespace

Result<CastRecipe> ParseCastRecipe(const JsonView& root) {
  LARARIUM_RETURN_IF_ERROR(OnlyFields(root, kFields));
  LARARIUM_RETURN_IF_ERROR(root.Integer("schema", kSchema, kSchema).status());
  CastRecipe recipe;
  LARARIUM_RETURN_IF_ERROR(ReadText(root, "name", recipe.name));
  LARARIUM_RETURN_IF_ERROR(ReadSex(root, recipe));
  LARARIUM_RETURN_IF_ERROR(ReadNumber(root, "age", 1.0, 90.0, recipe.age));
  LARARIUM_RETURN_IF_ERROR(ReadNumber(root, "muscle", 0.0, 1.0, recipe.muscle));
  LARARIUM_RETURN_IF_ERROR(ReadNumber(root, "weight", 0.0, 1.0, recipe.weight));
  LARARIUM_RETURN_IF_ERROR(ReadNumber(root, "proportions", 0.0, 1.0, recipe.proportions));
  LARARIUM_RETURN_IF_ERROR(ReadNumber(root, "breast_size", 0.0, 1.0, recipe.breast_size));
  LARARIUM_RETURN_IF_ERROR(ReadNumber(root, "breast_firmness", 0.0, 1.0, recipe.breast_firmness));
  LARARIUM_RETURN_IF_ERROR(ReadNumber(root, "asymmetry", 0.0, 1.0, recipe.asymmetry));
  if (root.Has("height")) {
    LARARIUM_ASSIGN_OR_RETURN(const double height, root.Number("height", 0.4, 2.5));
    recipe.height = static_cast<float>(height);
  }
  LARARIUM_RETURN_IF_ERROR(ReadEthnicity(root, recipe));
  LARARIUM_RETURN_IF_ERROR(ReadModifiers(root, recipe));
  LARARIUM_RETURN_IF_ERROR(ReadSkin(root, recipe));
  LARARIUM_RETURN_IF_ERROR(ReadText(root, "eyelashes", recipe.eyelashes));
  LARARIUM_RETURN_IF_ERROR(ReadText(root, "teeth", recipe.teeth));
  LARARIUM_RETURN_IF_ERROR(ReadText(root, "tongue", recipe.tongue));
  LARARIUM_RETURN_IF_ERROR(ReadDyedParts(root, recipe));
  LARARIUM_RETURN_IF_ERROR(ReadGarments(root, recipe));
  if (root.Has("seed")) {
    LARARIUM_ASSIGN_OR_RETURN(const int64_t seed, root.Integer("seed", 0, int64_t{1} << 53));
    recipe.seed = static_cast<uint64_t>(seed);
  }
  return recipe;
}

Result<CastRecipe> LoadCastRecipe(const std::filesystem::path& file) {
  LARARIUM_ASSIGN_OR_RETURN(const Json json, LoadJson(file));
  return ParseCastRecipe(JsonView(json, file.string()));
}

Json ToJson(const CastRecipe& recipe) {
  Json skin = {{"stubble", recipe.stubble},
               {"weathering", recipe.weathering},
               {"freckles", recipe.freckles},
               {"sunburn", recipe.sunburn}};
  if (!recipe.skin.empty()) {
    skin["name"] = recipe.skin;
  }
  if (recipe.skin_tint) {
    skin["tint"] = ColourText(*recipe.skin_tint);
  }
  Json ethnicity = Json::object();
  for (int i = 0; i < 3; ++i) {
    ethnicity[std::string(kEthnicities[i])] = recipe.ethnicity[i];
  }
  Json beard = Json::array();
  for (const CastDyed& part : recipe.beard) {
    beard.push_back(DyedJson(part));
  }
  Json json = {{"schema", kSchema},
               {"name", recipe.name},
               {"sex", recipe.sex},
               {"age", recipe.age},
               {"muscle", recipe.muscle},
               {"weight", recipe.weight},
               {"proportions", recipe.proportions},
               {"breast_size", recipe.breast_size},
               {"breast_firmness", recipe.breast_firmness},
               {"asymmetry", recipe.asymmetry},
               {"ethnicity", ethnicity},
               {"modifiers", recipe.modifiers},
               {"skin", skin},
               {"eyes", DyedJson(recipe.eyes)},
               {"eyebrows", DyedJson(recipe.eyebrows)},
               {"eyelashes", recipe.eyelashes},
               {"teeth", recipe.teeth},
               {"tongue", recipe.tongue},
               {"beard", beard},
               {"garments", recipe.garments},
               {"seed", recipe.seed}};
  if (recipe.height) {
    json["height"] = *recipe.height;
  }
  if (recipe.hair) {
    json["hair"] = DyedJson(*recipe.hair);
  }
  return json;
}

}  // namespace lararium::import
