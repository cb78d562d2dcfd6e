#pragma once

// The light around a point as rough surfaces reflect it: for each roughness and each reflected
// direction, the radiance weighted by the GGX lobe about that direction. This is the first of the
// two sums of Karis, "Real Shading in Unreal Engine 4", SIGGRAPH 2013 courses ("split sum").

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <vector>

#include "shared/core/status.h"

namespace lararium::light {

// Layers of octahedral maps about +Y (Engelhardt & Dachsbacher, VMV 2008) in stage axes. The
// outermost texels lie on the square's border, where it folds. Neighbours across the fold are the
// same texels, so that interpolation has no seam (shaders/include/glossy.glsl).
struct GlossyMap {
  static constexpr int kSize = 48;  // texels along a side
  static constexpr int kLayers = 6;
  static constexpr float kLeastRoughness = 0.1f;
  static constexpr size_t kTexels = size_t{kLayers} * kSize * kSize;

  // [layer][row][column]: linear RGB radiance as unsigned floats of 11, 11 and 10 bits, with red in
  // the lowest bits. Empty: no map.
  std::vector<uint32_t> texels;

  bool empty() const { return texels.empty(); }
};

// Roughness of a layer, in even steps from kLeastRoughness to 1.
float RoughnessOfLayer(int layer);
// Returns the unit direction of a texel.
glm::vec3 GlossyDirection(int column, int row);

uint32_t PackRadiance(const glm::vec3& radiance);
glm::vec3 UnpackRadiance(uint32_t texel);

// Weight of the light whose direction has this cosine with the reflected direction, viewed along
// the normal: D(h) (n l) of GGX (Walter et al., EGSR 2007), normalised to a maximum of 1.
double GlossyWeight(double cosine, double roughness);

// Computes the weighted sum of the maps into `blended`, which has kTexels elements. Empty maps are
// skipped. `maps` and `weights` have equal lengths. Allocates nothing.
void BlendGlossyMaps(std::span<const GlossyMap* const> maps,
                     std::span<const float> weights,
                     std::span<uint32_t> blended);

// Parses and checks the bytes of a glossy map file; errors call the bytes `where`.
Result<GlossyMap> ParseGlossyMap(std::span<const std::byte> bytes, const std::string& where);
std::vector<std::byte> SerializeGlossyMap(const GlossyMap& map);

}  // namespace lararium::light
