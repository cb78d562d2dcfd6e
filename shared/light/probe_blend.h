#pragma once

// Several probes of one place: between their positions and their times of day.

#include <glm/vec3.hpp>
#include <span>

#include "shared/light/probe_light.h"

namespace lararium::light {

inline constexpr double kNoon = 12.0;

struct PlacedProbe {
  glm::vec3 position = glm::vec3(0.0f);  // metres, stage axes
  double hour = kNoon;                   // of the day, 0 to 24
  ProbeLight light;
};

// Probes nearer than this are at one position, photographed at several times.
inline constexpr float kSamePosition = 0.05f;  // metres

// Part of the way from a to b, share 0 to 1. Skies in proportion. A sun in both turns the
// shortest way; one that is in one of them alone fades.
ProbeLight Mix(const ProbeLight& a, const ProbeLight& b, float share);

// The light at a position and an hour. At each position linear between the probes before and
// after the hour, around midnight; between positions by inverse squared distances (Shepard
// 1968), so that at a probe its own light is there alone. No probes: no light. Allocates
// nothing.
ProbeLight Blend(std::span<const PlacedProbe> probes, const glm::vec3& position, double hour);

}  // namespace lararium::light
