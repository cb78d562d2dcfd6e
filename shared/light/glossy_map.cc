#include "shared/light/glossy_map.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/packing.hpp>
#include <glm/vec2.hpp>

#include "shared/core/check.h"
#include "shared/light/octahedral.h"

namespace lararium::light {
namespace {

// The header holds magic, version, size and layers, four bytes each, little-endian. The texels
// follow.
constexpr char kMagic[4] = {'L', 'G', 'L', 'S'};
constexpr uint32_t kVersion = 1;
constexpr size_t kHeaderBytes = 16;

// The largest number of ten bits is 64512.
constexpr float kMostRadiance = 64000.0f;

// Exponents of all ones mark values that are not finite.
bool IsFinite(uint32_t texel) {
  return (texel >> 6 & 31u) != 31u && (texel >> 17 & 31u) != 31u && (texel >> 27 & 31u) != 31u;
}

}  // namespace

float RoughnessOfLayer(int layer) {
  return std::lerp(GlossyMap::kLeastRoughness, 1.0f,
                   static_cast<float>(layer) / static_cast<float>(GlossyMap::kLayers - 1));
}

glm::vec3 GlossyDirection(int column, int row) {
  return OctahedralDirection(
      2.0f * glm::vec2(column, row) / static_cast<float>(GlossyMap::kSize - 1) - 1.0f);
}

uint32_t PackRadiance(const glm::vec3& radiance) {
  return glm::packF2x11_1x10(glm::clamp(radiance, 0.0f, kMostRadiance));
}

glm::vec3 UnpackRadiance(uint32_t texel) { return glm::unpackF2x11_1x10(texel); }

double GlossyWeight(double cosine, double roughness) {
  // Viewed along the normal, the half vector is at half the angle of the light.
  const double half_sine2 = 0.5 * (1.0 - cosine);
  const double alpha2 = std::pow(roughness, 4.0);
  const double spread = alpha2 / (alpha2 + half_sine2 * (1.0 - alpha2));
  return std::max(cosine, 0.0) * spread * spread;
}

void BlendGlossyMaps(std::span<const GlossyMap* const> maps,
                     std::span<const float> weights,
                     std::span<uint32_t> blended) {
  CHECK(maps.size() == weights.size() && blended.size() == GlossyMap::kTexels);
  for (size_t texel = 0; texel < blended.size(); ++texel) {
    glm::vec3 sum(0.0f);
    for (size_t i = 0; i < maps.size(); ++i) {
      if (weights[i] > 0.0f && maps[i] != nullptr && !maps[i]->empty()) {
        sum += weights[i] * UnpackRadiance(maps[i]->texels[texel]);
      }
    }
    blended[texel] = PackRadiance(sum);
  }
}

Result<GlossyMap> ParseGlossyMap(std::span<const std::byte> bytes, const std::string& where) {
  uint32_t header[3] = {};
  if (bytes.size() < kHeaderBytes || std::memcmp(bytes.data(), kMagic, sizeof(kMagic)) != 0) {
    return Status::Error(where, "is not a reflection map", "bake the project again");
  }
  std::memcpy(header, bytes.data() + sizeof(kMagic), sizeof(header));
  if (header[0] != kVersion) {
    return Status::Error(where,
                         "has version " + std::to_string(header[0]) + ", this program reads " +
                             std::to_string(kVersion),
                         "bake the project again, or update this program");
  }
  if (header[1] != GlossyMap::kSize || header[2] != GlossyMap::kLayers ||
      bytes.size() != kHeaderBytes + GlossyMap::kTexels * sizeof(uint32_t)) {
    return Status::Error(where, "does not have the size of a reflection map",
                         "bake the project again");
  }
  GlossyMap map;
  map.texels.resize(GlossyMap::kTexels);
  std::memcpy(map.texels.data(), bytes.data() + kHeaderBytes, map.texels.size() * sizeof(uint32_t));
  if (!std::all_of(map.texels.begin(), map.texels.end(), IsFinite)) {
    return Status::Error(where, "contains light values that are not finite",
                         "bake the project again");
  }
  return map;
}

std::vector<std::byte> SerializeGlossyMap(const GlossyMap& map) {
  CHECK(map.texels.size() == GlossyMap::kTexels);
  const uint32_t header[3] = {kVersion, GlossyMap::kSize, GlossyMap::kLayers};
  std::vector<std::byte> bytes(kHeaderBytes + map.texels.size() * sizeof(uint32_t));
  std::memcpy(bytes.data(), kMagic, sizeof(kMagic));
  std::memcpy(bytes.data() + sizeof(kMagic), header, sizeof(header));
  std::memcpy(bytes.data() + kHeaderBytes, map.texels.data(), map.texels.size() * sizeof(uint32_t));
  return bytes;
}

}  // namespace lararium::light
