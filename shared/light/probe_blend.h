#pragma once

// Interpolates several probes of one place between their positions and times of day.

#include <glm/vec3.hpp>
#include <span>

#include "shared/light/probe_light.h"

namespace lararium::light {

inline constexpr double kNoon = 12.0;

struct PlacedProbe {
  glm::vec3 position = glm::vec3(0.0f);  // metres, stage axes
  double hour = kNoon;                   // hour of the day, 0 to 24
  ProbeLight light;
};

// Probes that are nearer than this share one position and were taken at several times.
inline constexpr float kSamePosition = 0.05f;  // metres

// Interpolates from a to b with share 0 to 1. Skies mix linearly. A sun in both turns along the
// shortest arc; a sun in only one of them fades.
ProbeLight Mix(const ProbeLight& a, const ProbeLight& b, float share);

// Returns the light at a position and an hour. At each position it is interpolated linearly between
// the probes before and after the hour, across midnight; between positions by inverse squared
// distances (Shepard 1968), so that a probe's own light remains unchanged at its position. Without
// probes there is no light. Allocates nothing.
ProbeLight Blend(std::span<const PlacedProbe> probes, const glm::vec3& position, double hour);

}  // namespace lararium::light
