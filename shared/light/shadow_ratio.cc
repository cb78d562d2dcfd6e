#include "shared/light/shadow_ratio.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <numbers>

#include "shared/core/check.h"
#include "shared/light/blocker_table.h"
#include "shared/light/quadrature.h"

namespace lararium::light {
namespace {

// Returns a frame of two directions that are orthonormal to `normal`, and `normal`.
glm::dmat3 FrameAbout(const glm::dvec3& normal) {
  const glm::dvec3 aside =
      std::abs(normal.x) < 0.5 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0);
  const glm::dvec3 first = glm::normalize(glm::cross(normal, aside));
  return glm::dmat3(first, glm::cross(normal, first), normal);
}

// Computes the ratio for eight receivers at a time. cosine(channel, k) returns M's coefficients as
// numbers or as registers.
template <typename CosineLightAt>
void RatioRange(const ShRows& log_visibility,
                ReceiverRange range,
                const RgbSpans& ratio,
                const CosineLightAt& cosine) {
  CheckRegisters(range, log_visibility);
  CHECK(ratio.r.size() == log_visibility.receivers() && ratio.g.size() == ratio.r.size() &&
        ratio.b.size() == ratio.r.size());
  const int count = log_visibility.count();
  const ShProductTable& products = ShProductTable::ForCount(count);
  const float one = std::sqrt(4.0f * std::numbers::pi_v<float>);
  const std::span<float> channels[3] = {ratio.r, ratio.g, ratio.b};
  for (size_t i = range.begin; i < range.end; i += kLanes) {
    Lanes log[25], visibility[25];
    for (int k = 0; k < count; ++k) {
      log[k] = Load(log_visibility.row(k) + i);
    }
    ExpSh(products, log, visibility);
    for (size_t channel = 0; channel < 3; ++channel) {
      Lanes shadowed = {};
      for (int k = 0; k < count; ++k) {
        shadowed += visibility[k] * cosine(channel, k, i);
      }
      const Lanes unshadowed = Lanes{} + one * cosine(channel, 0, i);
      const Lanes quotient = shadowed / Max(unshadowed, Broadcast(1e-12f));
      const Lanes bounded = Min(Max(quotient, Lanes{}), Broadcast(1.0f));
      const Lanes result = unshadowed > 1e-12f ? bounded : Broadcast(1.0f);
      StoreFirst(result, channels[channel].data() + i, range.end - i);
    }
  }
}

}  // namespace

ShRgb CosineLight(const ShRgb& light, const glm::vec3& normal) {
  const glm::dmat3 frame = FrameAbout(glm::normalize(glm::dvec3(normal)));
  std::array<glm::dvec3, kShCount> sums{};
  // Light, cosine and basis function together have degree 2 kShDegree + 1.
  for (const SphereNode& node : SphereQuadrature(2 * kShDegree + 1, 0.0, 1.0)) {
    const glm::dvec3 d = frame * node.direction;
    std::array<double, kShCount> basis;
    EvaluateShBasis<kShCount>(d.x, d.y, d.z, ShNormalisation().data(), basis.data());
    glm::dvec3 radiance(0.0);
    for (size_t k = 0; k < kShCount; ++k) {
      radiance += basis[k] * glm::dvec3(light[k]);
    }
    radiance *= node.weight * node.direction.z;
    for (size_t k = 0; k < kShCount; ++k) {
      sums[k] += basis[k] * radiance;
    }
  }
  ShRgb cosine_light;
  for (size_t k = 0; k < kShCount; ++k) {
    cosine_light[k] = glm::vec3(sums[k]);
  }
  return cosine_light;
}

void ShadowRatio(const ShRgb& cosine_light,
                 const ShRows& log_visibility,
                 ReceiverRange range,
                 const RgbSpans& ratio) {
  RatioRange(log_visibility, range, ratio, [&](size_t channel, int k, size_t) {
    return cosine_light[static_cast<size_t>(k)][static_cast<int>(channel)];
  });
}

void ShadowRatio(const ShRowsRgb& cosine_light,
                 const ShRows& log_visibility,
                 ReceiverRange range,
                 const RgbSpans& ratio) {
  for (const ShRows& rows : cosine_light) {
    CHECK(rows.count() == log_visibility.count() && rows.stride() == log_visibility.stride());
  }
  RatioRange(log_visibility, range, ratio, [&](size_t channel, int k, size_t i) {
    return Load(cosine_light[channel].row(k) + i);
  });
}

}  // namespace lararium::light
