#include "editor/bake/glossy_probe.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "shared/core/parallel.h"
#include "shared/core/units.h"

namespace lararium::bake {
namespace {

using light::GlossyMap;

// Directions and radiance of the texels of an image, row by row.
struct GlossySource {
  int width = 0;
  int height = 0;
  std::vector<glm::vec3> directions;  // stage axes
  std::vector<glm::vec3> radiance;
  std::vector<float> solid_angles;  // Indexed by row.

  double polar(int row) const { return kPi * (row + 0.5) / height; }
};

// Box-filters the image to a width that divides its own, or keeps it if it is narrower. Texels
// of a block have equal weight, because their solid angles hardly differ.
GlossySource Shrunk(const ProbeImage& image, const ProbePlacement& placement, int width) {
  const int block = std::max(1, image.width / width);
  GlossySource source;
  source.width = image.width / block;
  source.height = image.height / block;
  for (int row = 0; row < source.height; ++row) {
    const double polar = source.polar(row);
    source.solid_angles.push_back(static_cast<float>(
        2.0 * kPi / source.width *
        (std::cos(kPi * row / source.height) - std::cos(kPi * (row + 1) / source.height))));
    for (int column = 0; column < source.width; ++column) {
      const double azimuth = 2.0 * kPi * ((column + 0.5) / source.width - 0.5);
      source.directions.push_back(placement.stage_from_probe *
                                  glm::vec3(std::sin(polar) * std::sin(azimuth), std::cos(polar),
                                            -std::sin(polar) * std::cos(azimuth)));
      glm::vec3 sum(0.0f);
      for (int y = row * block; y < (row + 1) * block; ++y) {
        for (int x = column * block; x < (column + 1) * block; ++x) {
          sum += image.pixels[static_cast<size_t>(y) * static_cast<size_t>(image.width) +
                              static_cast<size_t>(x)];
        }
      }
      source.radiance.push_back(sum * placement.radiance_scale / static_cast<float>(block * block));
    }
  }
  return source;
}

// A lobe tabulated over the square root of 1 - cosine, which is nearly proportional to the
// angle.
class Lobe {
 public:
  // Never narrower than texels of this angle, so that no texel is missed.
  Lobe(double roughness, double texel) {
    const double widened = std::sqrt(std::pow(roughness, 4.0) + 0.25 * texel * texel);
    const double blurred = std::sqrt(std::min(widened, 1.0));
    for (size_t i = 0; i < kEntries; ++i) {
      const double x = static_cast<double>(i) / (kEntries - 1);  // sin of half the angle
      weights_[i] = static_cast<float>(light::GlossyWeight(1.0 - 2.0 * x * x, blurred));
      if (weights_[i] > kNegligible) {
        reach_ = 2.0 * std::asin(std::min(1.0, static_cast<double>(i + 1) / (kEntries - 1)));
      }
    }
  }

  float Weight(float cosine) const {
    const float at = std::sqrt(std::max(0.5f - 0.5f * cosine, 0.0f)) * (kEntries - 1);
    const auto below = std::min(static_cast<size_t>(at), kEntries - 2);
    return std::lerp(weights_[below], weights_[below + 1], at - static_cast<float>(below));
  }
  // The angle beyond which almost nothing of the lobe is left.
  double reach() const { return reach_; }

 private:
  static constexpr size_t kEntries = 2048;
  static constexpr float kNegligible = 1e-5f;

  std::vector<float> weights_ = std::vector<float>(kEntries);
  double reach_ = 0.0;
};

glm::vec3 Filtered(const GlossySource& source,
                   const Lobe& lobe,
                   const glm::vec3& direction,
                   const glm::vec3& probe_direction) {
  const double polar = std::acos(std::clamp(static_cast<double>(probe_direction.y), -1.0, 1.0));
  const double rows = source.height / kPi;
  const int first = std::max(0, static_cast<int>((polar - lobe.reach()) * rows) - 1);
  const int last = std::min(source.height - 1, static_cast<int>((polar + lobe.reach()) * rows) + 1);
  glm::dvec3 sum(0.0);
  double weights = 0.0;
  for (int row = first; row <= last; ++row) {
    glm::vec3 row_sum(0.0f);
    float row_weights = 0.0f;
    const size_t begin = static_cast<size_t>(row) * static_cast<size_t>(source.width);
    for (size_t i = begin; i < begin + static_cast<size_t>(source.width); ++i) {
      const float cosine = glm::dot(source.directions[i], direction);
      if (cosine > 0.0f) {
        const float weight = lobe.Weight(cosine);
        row_sum += weight * source.radiance[i];
        row_weights += weight;
      }
    }
    const auto solid_angle = static_cast<double>(source.solid_angles[static_cast<size_t>(row)]);
    sum += solid_angle * glm::dvec3(row_sum);
    weights += solid_angle * static_cast<double>(row_weights);
  }
  return weights > 0.0 ? glm::vec3(sum / weights) : glm::vec3(0.0f);
}

}  // namespace

light::GlossyMap PrefilterProbe(const ProbeImage& sky, const ProbePlacement& placement) {
  constexpr int kWidth = 128;  // Width of the source for the wider lobes.
  const GlossySource fine = Shrunk(sky, placement, 2 * kWidth);
  const GlossySource coarse = Shrunk(sky, placement, kWidth);
  const glm::quat probe_from_stage = glm::conjugate(placement.stage_from_probe);
  GlossyMap map;
  map.texels.resize(GlossyMap::kTexels);
  for (int layer = 0; layer < GlossyMap::kLayers; ++layer) {
    const GlossySource& source = layer < 2 ? fine : coarse;
    const Lobe lobe(light::RoughnessOfLayer(layer), kPi / source.height);
    ParallelFor(GlossyMap::kSize, [&](size_t row) {
      for (int column = 0; column < GlossyMap::kSize; ++column) {
        const glm::vec3 direction = light::GlossyDirection(column, static_cast<int>(row));
        const size_t texel =
            (static_cast<size_t>(layer) * GlossyMap::kSize + row) * GlossyMap::kSize +
            static_cast<size_t>(column);
        map.texels[texel] =
            light::PackRadiance(Filtered(source, lobe, direction, probe_from_stage * direction));
      }
    });
  }
  return map;
}

}  // namespace lararium::bake
