#include "editor/import/cast/cast_recipe.h"

#include <array>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <string_view>

namespace lararium::import {
namespace {

constexpr int kSchema = 1;
constexpr size_t kMaxName = 200;
constexpr std::array<std::string_view, 3> kEthnicities = {"caucasian", "african", "asian"};

int HexDigit(char c) {
  if (c >= '0' && c <= '9') {
    return c - '0';
  }
  if (c >= 'a' && c <= 'f') {
    return c - 'a' + 10;
  }
  return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
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

void DescribeColour(Fields& fields, std::string_view name, std::optional<glm::vec3>& colour) {
  if (!fields.Has(name, colour.has_value())) {
    return;
  }
  std::string text = colour ? ColourText(*colour) : "";
  fields.Text(name, text, 20);
  bool valid = text.size() == 7 && text[0] == '#';
  glm::vec3 value(0.0f);
  for (int channel = 0; valid && channel < 3; ++channel) {
    const int high = HexDigit(text[1 + 2 * channel]);
    const int low = HexDigit(text[2 + 2 * channel]);
    valid = high >= 0 && low >= 0;
    value[channel] = static_cast<float>(16 * high + low) / 255.0f;
  }
  fields.RequireAt(name, valid, "'" + text + "' is not a colour", "write it as \"#rrggbb\"");
  if (fields.reading()) {
    colour = value;
  }
}

// "name" or {"name": ..., "colour": ...}.
void DescribeDyed(Fields& fields, const FieldKey& key, CastDyed& dyed) {
  if (fields.IsText(key)) {
    fields.Text(key, dyed.name, kMaxName);
    return;
  }
  fields.Object(key, dyed, [](Fields& object, CastDyed& part) {
    object.Text("name", part.name, kMaxName);
    DescribeColour(object, "colour", part.colour);
    object.Number(Optional("volume"), part.volume, 0.1, 2.0);
    float degrees = glm::degrees(part.tilt);
    object.Number(Optional("tilt_deg"), degrees, -45.0, 45.0);
    if (object.reading()) {
      part.tilt = glm::radians(degrees);
    }
  });
}

void DescribeSex(Fields& fields, float& sex) {
  if (!fields.IsText("sex")) {
    fields.Number(Optional("sex"), sex, 0.0, 1.0);
    return;
  }
  std::string text;
  fields.Text("sex", text, 20);
  fields.RequireAt("sex", text == "female" || text == "male",
                   "must be \"female\", \"male\" or a number from 0 to 1");
  sex = text == "male" ? 1.0f : 0.0f;
}

void DescribeEthnicity(Fields& fields, glm::vec3& shares) {
  if (fields.reading()) {
    shares = glm::vec3(0.0f);
  }
  for (int i = 0; i < 3; ++i) {
    fields.Number(Optional(kEthnicities[i]), shares[i], 0.0, 1.0);
  }
}

void DescribeSkin(Fields& fields, CastRecipe& recipe) {
  fields.Text(Optional("name", !recipe.skin.empty()), recipe.skin, kMaxName);
  DescribeColour(fields, "tint", recipe.skin_tint);
  fields.Number(Optional("stubble"), recipe.stubble, 0.0, 1.0);
  fields.Number(Optional("weathering"), recipe.weathering, 0.0, 1.0);
  fields.Number(Optional("freckles"), recipe.freckles, 0.0, 1.0);
  fields.Number(Optional("sunburn"), recipe.sunburn, 0.0, 1.0);
}

}  // namespace

void DescribeFields(Fields& fields, CastRecipe& recipe) {
  fields.Schema(kSchema);
  fields.Text(Optional("name"), recipe.name, kMaxName);
  DescribeSex(fields, recipe.sex);
  fields.Number(Optional("age"), recipe.age, 1.0, 90.0);
  fields.Number(Optional("muscle"), recipe.muscle, 0.0, 1.0);
  fields.Number(Optional("weight"), recipe.weight, 0.0, 1.0);
  fields.Number(Optional("proportions"), recipe.proportions, 0.0, 1.0);
  fields.Number(Optional("breast_size"), recipe.breast_size, 0.0, 1.0);
  fields.Number(Optional("breast_firmness"), recipe.breast_firmness, 0.0, 1.0);
  fields.Number(Optional("asymmetry"), recipe.asymmetry, 0.0, 1.0);
  fields.Number("height", recipe.height, 0.4, 2.5);
  fields.Object(Optional("ethnicity"), recipe.ethnicity, DescribeEthnicity);
  const glm::vec3& shares = recipe.ethnicity;
  fields.RequireAt("ethnicity", shares.x + shares.y + shares.z > 0.0f, "one share must be above 0");
  fields.Entries(
      Optional("modifiers"), recipe.modifiers, 1000, "must be an object of at most 1000 sliders",
      [&](const FieldKey& slider, float& value) { fields.Number(slider, value, -2.0, 2.0); });
  fields.Object(Optional("skin"), recipe, DescribeSkin);
  fields.Text(Optional("eyelashes"), recipe.eyelashes, kMaxName);
  fields.Text(Optional("teeth"), recipe.teeth, kMaxName);
  fields.Text(Optional("tongue"), recipe.tongue, kMaxName);
  DescribeDyed(fields, Optional("eyes"), recipe.eyes);
  DescribeDyed(fields, Optional("eyebrows"), recipe.eyebrows);
  if (fields.Has("hair", recipe.hair.has_value())) {
    DescribeDyed(fields, "hair", recipe.hair ? *recipe.hair : recipe.hair.emplace());
  }
  fields.List(Optional("beard"), recipe.beard, 4,
              [&](const FieldKey& key, CastDyed& part) { DescribeDyed(fields, key, part); });
  fields.List(Optional("garments"), recipe.garments, 16, [&](const FieldKey& key, Json& garment) {
    fields.Raw(key, garment);
    fields.Check(JsonView(garment, fields.where(key)).Text("name", kMaxName).status());
  });
  fields.Integer(Optional("seed"), recipe.seed, 0, int64_t{1} << 53);
}

Result<CastRecipe> LoadCastRecipe(const std::filesystem::path& file) {
  LARARIUM_ASSIGN_OR_RETURN(const Json json, LoadJson(file));
  return ParseFields<CastRecipe>(JsonView(json, file.string()));
}

}  // namespace lararium::import
