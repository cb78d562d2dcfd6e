#include "shared/light/probe_blend.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <optional>
#include <vector>

namespace lararium::light {
namespace {

// Hours from one time of day to a later one, around midnight.
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
  // Along the great circle.
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

// Probes of one position: between the hour before and the hour after.
ProbeLight AtHour(std::span<const PlacedProbe* const> probes, double hour) {
  const PlacedProbe* before = probes[0];
  const PlacedProbe* after = probes[0];
  for (const PlacedProbe* probe : probes) {
    if (HoursUntil(probe->hour, hour) < HoursUntil(before->hour, hour)) {
      before = probe;
    }
    if (HoursUntil(hour, probe->hour) < HoursUntil(hour, after->hour)) {
      after = probe;
    }
  }
  const double between = HoursUntil(before->hour, after->hour);
  const double share = between > 0.0 ? HoursUntil(before->hour, hour) / between : 0.0;
  return Mix(before->light, after->light, static_cast<float>(share));
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

ProbeLight Blend(std::span<const PlacedProbe> probes, const glm::vec3& position, double hour) {
  ProbeLight blended;
  float total = 0.0f;
  std::vector<bool> taken(probes.size(), false);
  for (size_t i = 0; i < probes.size(); ++i) {
    if (taken[i]) {
      continue;
    }
    std::vector<const PlacedProbe*> here;
    for (size_t k = i; k < probes.size(); ++k) {
      if (!taken[k] && glm::distance(probes[k].position, probes[i].position) < kSamePosition) {
        here.push_back(&probes[k]);
        taken[k] = true;
      }
    }
    const float distance = glm::distance(position, probes[i].position);
    const ProbeLight light = AtHour(here, hour);
    if (distance < 1e-3f) {
      return light;
    }
    const float weight = 1.0f / (distance * distance);
    total += weight;
    blended = total == weight ? light : Mix(blended, light, weight / total);
  }
  return blended;
}

}  // namespace lararium::light
