#include "shared/light/probe_blend.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <optional>

#include "shared/core/check.h"
#include "shared/light/probe_weights.h"

namespace lararium::light {
namespace {

// Hours from one time of day to a later one, across midnight.
double HoursUntil(double from, double to) {
  const double hours = std::fmod(to - from, 24.0);
  return hours < 0.0 ? hours + 24.0 : hours;
}

std::optional<Sun> MixSuns(const std::optional<Sun>& a, const std::optional<Sun>& b, float share) {
  if (!a && !b) {
    return std::nullopt;
  }
  if (!a || !b) {
    Sun sun = a ? *a : *b;
    sun.irradiance *= a ? 1.0f - share : share;
    return sun;
  }
  // Interpolates along the great circle.
  const float angle = std::acos(std::clamp(glm::dot(a->direction, b->direction), -1.0f, 1.0f));
  glm::vec3 direction = glm::mix(a->direction, b->direction, share);
  if (angle > 1e-3f && angle < 3.14f) {
    direction =
        std::sin((1.0f - share) * angle) * a->direction + std::sin(share * angle) * b->direction;
  }
  const float length = glm::length(direction);
  return Sun{length > 1e-6f ? direction / length : a->direction,
             glm::mix(a->irradiance, b->irradiance, share),
             std::lerp(a->angular_radius, b->angular_radius, share)};
}

bool SamePosition(const PlacedProbe& a, const PlacedProbe& b) {
  return glm::distance(a.position, b.position) < kSamePosition;
}

// Distributes the share of a position to its probes before and after the hour.
void AddAtHour(std::span<const PlacedProbe> probes,
               size_t here,
               double hour,
               float share,
               std::span<float> weights) {
  size_t before = here;
  size_t after = here;
  for (size_t i = 0; i < probes.size(); ++i) {
    if (!SamePosition(probes[i], probes[here])) {
      continue;
    }
    if (HoursUntil(probes[i].hour, hour) < HoursUntil(probes[before].hour, hour)) {
      before = i;
    }
    if (HoursUntil(hour, probes[i].hour) < HoursUntil(hour, probes[after].hour)) {
      after = i;
    }
  }
  const double between = HoursUntil(probes[before].hour, probes[after].hour);
  const double passed = HoursUntil(probes[before].hour, hour);
  const float later = between > 0.0 ? static_cast<float>(passed / between) : 0.0f;
  weights[before] += share * (1.0f - later);
  weights[after] += share * later;
}

// True if an earlier probe in the list has the same position.
bool IsRepeated(std::span<const PlacedProbe> probes, size_t index) {
  return std::any_of(probes.begin(), probes.begin() + static_cast<ptrdiff_t>(index),
                     [&](const PlacedProbe& other) { return SamePosition(other, probes[index]); });
}

// The result stays finite at the probe itself.
float Nearness(const PlacedProbe& probe, const glm::vec3& position) {
  const float distance = std::max(glm::distance(position, probe.position), 1e-3f);
  return 1.0f / (distance * distance);
}

}  // namespace

ProbeLight Mix(const ProbeLight& a, const ProbeLight& b, float share) {
  ProbeLight mixed;
  for (int i = 0; i < kShCount; ++i) {
    mixed.sky[i] = glm::mix(a.sky[i], b.sky[i], share);
  }
  mixed.sun = MixSuns(a.sun, b.sun, share);
  return mixed;
}

void ComputeProbeWeights(std::span<const PlacedProbe> probes,
                         const glm::vec3& position,
                         double hour,
                         std::span<float> weights) {
  CHECK(weights.size() == probes.size());
  std::fill(weights.begin(), weights.end(), 0.0f);
  float total = 0.0f;
  for (size_t i = 0; i < probes.size(); ++i) {
    total += IsRepeated(probes, i) ? 0.0f : Nearness(probes[i], position);
  }
  for (size_t i = 0; i < probes.size(); ++i) {
    if (!IsRepeated(probes, i)) {
      AddAtHour(probes, i, hour, Nearness(probes[i], position) / total, weights);
    }
  }
}

ProbeLight Blend(std::span<const PlacedProbe> probes, const glm::vec3& position, double hour) {
  CHECK(probes.size() <= kMaxPlacedProbes);
  std::array<float, kMaxPlacedProbes> all;
  const std::span<float> weights(all.data(), probes.size());
  ComputeProbeWeights(probes, position, hour, weights);
  ProbeLight blended;
  float total = 0.0f;
  for (size_t i = 0; i < probes.size(); ++i) {
    if (weights[i] > 0.0f) {
      const bool first = total == 0.0f;
      total += weights[i];
      blended = first ? probes[i].light : Mix(blended, probes[i].light, weights[i] / total);
    }
  }
  return blended;
}

}  // namespace lararium::light
