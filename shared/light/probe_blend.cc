#include "shared/light/probe_blend.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <optional>

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

bool SamePosition(const PlacedProbe& a, const PlacedProbe& b) {
  return glm::distance(a.position, b.position) < kSamePosition;
}

// The probes at the position of one of them: between the hour before and the hour after.
ProbeLight AtHour(std::span<const PlacedProbe> probes, const PlacedProbe& here, double hour) {
  const PlacedProbe* before = &here;
  const PlacedProbe* after = &here;
  for (const PlacedProbe& probe : probes) {
    if (!SamePosition(probe, here)) {
      continue;
    }
    if (HoursUntil(probe.hour, hour) < HoursUntil(before->hour, hour)) {
      before = &probe;
    }
    if (HoursUntil(hour, probe.hour) < HoursUntil(hour, after->hour)) {
      after = &probe;
    }
  }
  const double between = HoursUntil(before->hour, after->hour);
  const double share = between > 0.0 ? HoursUntil(before->hour, hour) / between : 0.0;
  return Mix(before->light, after->light, static_cast<float>(share));
}

// Whether a probe before this one stands at the same position.
bool IsRepeated(std::span<const PlacedProbe> probes, size_t index) {
  return std::any_of(probes.begin(), probes.begin() + static_cast<ptrdiff_t>(index),
                     [&](const PlacedProbe& other) { return SamePosition(other, probes[index]); });
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
  for (size_t i = 0; i < probes.size(); ++i) {
    if (IsRepeated(probes, i)) {
      continue;
    }
    const float distance = glm::distance(position, probes[i].position);
    const ProbeLight light = AtHour(probes, probes[i], hour);
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
