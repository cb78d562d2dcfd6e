// libFuzzer harness: reading any bytes as a garment of a recipe terminates, and an accepted garment
// can be cut: its numbers are finite and in range.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "editor/import/wardrobe/garment_pattern.h"
#include "shared/core/check.h"
#include "shared/core/json.h"
#include "shared/core/json_fields.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace lararium;
  const auto json = ParseJson(std::string_view(reinterpret_cast<const char*>(data), size), "fuzz");
  if (!json.ok()) {
    return 0;
  }
  const auto pattern = ParseFields<import::GarmentPattern>(JsonView(*json, "fuzz"));
  if (pattern.ok()) {
    CHECK(pattern->hem > 0.0f && pattern->hem <= 2.0f);
    CHECK(pattern->ease >= 1.0f && pattern->ease <= 3.0f);
    CHECK(pattern->blouse >= 0.0f && pattern->blouse < 0.2f);
    CHECK(std::isfinite(pattern->colour.x + pattern->colour.y + pattern->colour.z));
  }
  return 0;
}
