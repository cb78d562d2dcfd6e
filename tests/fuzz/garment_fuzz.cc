// libFuzzer harness: reading any bytes as a formula, as a garment's file, or as a garment of a
// recipe, terminates. The formulas of an accepted file can be computed, and an accepted recipe sets
// every parameter to a finite number.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string_view>

#include "editor/import/wardrobe/formula.h"
#include "editor/import/wardrobe/garment_design.h"
#include "editor/import/wardrobe/garment_pattern.h"
#include "shared/core/check.h"
#include "shared/core/json.h"
#include "shared/core/json_fields.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace lararium;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto one = [](std::string_view) { return 1.0f; };
  if (const auto formula = import::Formula::Parse(text, "fuzz"); formula.ok()) {
    formula->Value(one);
  }
  const auto json = ParseJson(text, "fuzz");
  if (!json.ok()) {
    return 0;
  }
  import::GarmentPattern pattern;
  auto design = import::ParseGarment(text, "fuzz/garment.json");
  if (design.ok()) {
    CHECK(!design->pieces.empty());
    for (const auto& [name, formula] : design->sizes) {
      formula.Value(one);
    }
    pattern = import::UsualPattern(std::make_shared<const import::GarmentDesign>(*design));
  } else if (const auto parsed = ParseFields<import::GarmentPattern>(JsonView(*json, "fuzz"));
             parsed.ok()) {
    pattern = *parsed;
  } else {
    return 0;
  }
  for (const import::GarmentParameter& parameter : pattern.design->parameters) {
    if (parameter.type == import::GarmentParameter::Type::kColour) {
      const glm::vec3& colour = pattern.Colour(parameter.name);
      CHECK(std::isfinite(colour.x + colour.y + colour.z));
    } else {
      CHECK(std::isfinite(pattern.numbers.at(parameter.name)));
    }
  }
  return 0;
}
