#pragma once

// The light around a point as rough surfaces mirror it: for each roughness the radiance about
// every mirrored direction, weighed by the GGX lobe that is seen along it. The first of the two
// sums of Karis, "Real Shading in Unreal Engine 4", SIGGRAPH 2013 courses ("split sum").

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <vector>

#include "shared/core/status.h"

namespace lararium::light {

// Layers of octahedral maps about +Y (Engelhardt & Dachsbacher, VMV 2008) in stage axes. The
// outermost texels lie on the square's border, where it folds: neighbours across the fold are
// the same texels, so that interpolation has no seam (shaders/include/glossy.glsl).
struct GlossyMap {
  static constexpr int kSize = 48;  // texels along a side
  static constexpr int kLayers = 6;
  static constexpr float kLeastRoughness = 0.1f;
  static constexpr size_t kTexels = size_t{kLayers} * kSize * kSize;

  // [layer][row][column]: linear RGB radiance as unsigned floats of 11, 11 and 10 bits, red in
  // the lowest; empty: no map.
  std::vector<uint32_t> texels;

  bool empty() const { return texels.empty(); }
};

// From kLeastRoughness evenly to 1.
float RoughnessOfLayer(int layer);
// The unit direction of a texel.
glm::vec3 GlossyDirection(int column, int row);
// The texel of a direction, not whole: its column and row.
glm::vec2 GlossyTexel(const glm::vec3& direction);

uint32_t PackRadiance(const glm::vec3& radiance);
glm::vec3 UnpackRadiance(uint32_t texel);

// The weight of the light from a direction whose cosine with the mirrored one is given, seen
// along the normal: D(h) (n l) of GGX (Walter et al., EGSR 2007), 1 at its top.
double GlossyWeight(double cosine, double roughness);

// sum of weight times map; maps that are empty are left out. All spans are equally long.
// blended has kTexels. Allocates nothing.
void BlendGlossyMaps(std::span<const GlossyMap* const> maps,
                     std::span<const float> weights,
                     std::span<uint32_t> blended);

// A file of its own: checks everything. place: what errors call the bytes.
Result<GlossyMap> ParseGlossyMap(std::span<const std::byte> bytes, const std::string& place);
std::vector<std::byte> SerializeGlossyMap(const GlossyMap& map);

}  // namespace lararium::light
