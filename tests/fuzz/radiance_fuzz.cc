// libFuzzer harness: any bytes as a Radiance image are read completely or refused.

#include <cmath>
#include <span>

#include "editor/bake/radiance.h"
#include "shared/core/check.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const auto image =
      lararium::bake::ParseRadiance(std::as_bytes(std::span(data, size)), "fuzz: radiance");
  if (image.ok()) {
    CHECK(image->pixels.size() ==
          static_cast<size_t>(image->width) * static_cast<size_t>(image->height));
    for (const glm::vec3& pixel : image->pixels) {
      CHECK(std::isfinite(pixel.r) && pixel.r >= 0.0f);
    }
  }
  return 0;
}
