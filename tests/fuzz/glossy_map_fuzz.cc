// libFuzzer harness: a reflection map that begins with the input and is cut or padded as its first
// byte says. It is read or refused; an accepted map can be blended.

#include <algorithm>
#include <span>

#include "shared/core/check.h"
#include "shared/light/glossy_map.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using lararium::light::GlossyMap;
  if (size == 0) {
    return 0;
  }
  const GlossyMap even{std::vector<uint32_t>(GlossyMap::kTexels, 0)};
  std::vector<std::byte> bytes = lararium::light::SerializeGlossyMap(even);
  const auto input = std::as_bytes(std::span(data + 1, size - 1));
  std::copy(input.begin(), input.end(), bytes.begin());
  if (data[0] % 2 == 1) {
    bytes.resize(input.size());
  }
  const auto map = lararium::light::ParseGlossyMap(bytes, "fuzz.gloss");
  if (map.ok()) {
    CHECK(map->texels.size() == GlossyMap::kTexels);
    for (const uint32_t texel : map->texels) {
      const glm::vec3 radiance = lararium::light::UnpackRadiance(texel);
      CHECK(radiance.r >= 0.0f && radiance.g >= 0.0f && radiance.b >= 0.0f && radiance.r < 1e5f);
    }
  }
  return 0;
}
