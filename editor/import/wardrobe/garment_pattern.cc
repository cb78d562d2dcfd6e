#include "editor/import/wardrobe/garment_pattern.h"

#include <algorithm>
#include <utility>

#include "editor/import/wardrobe/dye.h"
#include "shared/core/check.h"
#include "shared/core/json.h"
#include "shared/core/json_fields.h"

namespace lararium::import {
namespace {

// The design of the field "name".
std::shared_ptr<const GarmentDesign> DesignOf(Fields& fields) {
  std::string name;
  fields.Text("name", name, 100);
  std::string known;
  for (const std::string& other : GarmentNames()) {
    if (other == name) {
      Result<GarmentDesign> design = LoadGarment(name);
      fields.Check(design.ok() ? Status() : design.status());
      return design.ok() ? std::make_shared<const GarmentDesign>(*std::move(design)) : nullptr;
    }
    known += (known.empty() ? "choose one of: " : ", ") + other;
  }
  fields.RequireAt("name", false, "there is no '" + name.substr(0, 40) + "'",
                   known.empty() ? "install the editor again" : known);
  return nullptr;
}

}  // namespace

void DescribeWordOrNumber(Fields& fields,
                          const FieldKey& key,
                          const GarmentParameter& parameter,
                          float& value) {
  if (!key.required && !fields.Has(key.name)) {
    return;
  }
  if (parameter.has_range && !fields.IsText(key)) {
    fields.Number(key, value, parameter.from, parameter.to);
    return;
  }
  std::string text;
  std::string known;
  fields.Text(key, text, 100);
  for (const GarmentParameter::Word& word : parameter.words) {
    if (word.word == text) {
      value = word.value;
      return;
    }
    known += (known.empty() ? "choose one of: " : ", ") + word.word;
  }
  fields.RequireAt(key, false, "there is no '" + text.substr(0, 40) + "'", known);
}

void DescribeFields(Fields& fields, GarmentPattern& pattern) {
  if (std::shared_ptr<const GarmentDesign> design = DesignOf(fields); design != nullptr) {
    DescribeFields(fields, std::move(design), pattern);
  }
}

void DescribeFields(Fields& fields,
                    std::shared_ptr<const GarmentDesign> design,
                    GarmentPattern& pattern) {
  fields.Has("name");
  pattern.design = std::move(design);
  for (const GarmentParameter& parameter : pattern.design->parameters) {
    if (parameter.type == GarmentParameter::Type::kColour) {
      glm::vec3& colour = pattern.colours[parameter.name];
      colour = parameter.colour;
      DescribeDye(fields, parameter.name, colour);
      continue;
    }
    float& value = pattern.numbers[parameter.name];
    value = parameter.usual;
    if (parameter.type == GarmentParameter::Type::kFlag) {
      bool flag = value != 0.0f;
      fields.Flag(Optional(parameter.name), flag);
      value = flag ? 1.0f : 0.0f;
    } else {
      DescribeWordOrNumber(fields, Optional(parameter.name), parameter, value);
    }
  }
  for (const std::string& ignored : pattern.design->ignored) {
    fields.Has(ignored);
  }
  fields.Integer(Optional("seed"), pattern.seed, 0, 1'000'000'000);
}

GarmentPattern UsualPattern(std::shared_ptr<const GarmentDesign> design) {
  GarmentPattern pattern;
  const Json nothing = Json::object();
  const Status read = ReadFields(JsonView(nothing, design->file.string()),
                                 [&](Fields& fields) { DescribeFields(fields, design, pattern); });
  CHECK(read.ok());
  return pattern;
}

}  // namespace lararium::import
