#pragma once

// Small lights on the stage, such as flames and embers, as balls of uniform radiance. From a
// receiver a lamp is a disc, whose harmonics are zonal and have a closed form (Sloan, "Stupid
// Spherical Harmonics (SH) Tricks", GDC 2008, "Analytic Light Sources"). Stage axes, metres.
// Allocates nothing.

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <span>

#include "shared/light/lamp_walls.h"
#include "shared/light/receivers.h"
#include "shared/light/sh_rows.h"
#include "shared/light/sun.h"

namespace lararium::light {

struct Lamp {
  glm::vec3 position = glm::vec3(0.0f);
  // Linear RGB irradiance on a surface that faces the lamp at one metre: pi times radiance times
  // radius squared.
  glm::vec3 intensity = glm::vec3(0.0f);
  float radius = 0.05f;
  // Walls of the real place that shadow the lamp's light; nullptr: no walls.
  std::shared_ptr<const LampWalls> walls = nullptr;
};

// Maximum number of lamps in a frame; the brightest are used.
inline constexpr size_t kMaxLamps = 8;
// At less than this many radii a lamp gets no brighter.
inline constexpr float kNearestLamp = 1.02f;
// A lamp with a lower irradiance on a facing surface can be skipped: less than one 8-bit step on
// white skin.
inline constexpr float kLeastLampIrradiance = 0.01f;

// Returns the lamp as a source in one direction, as seen from a point.
Sun SeenFrom(const Lamp& lamp, const glm::vec3& point);

// Distance in metres beyond which a facing surface gets less than `irradiance` from the lamp.
float ReachOf(const Lamp& lamp, float irradiance);

// Adds the lamps' radiance to the receivers of range, in as many rows as own_log has: 9, 16 or 25.
// own_log is the log visibility past the receivers' own body; its value towards a lamp dims that
// lamp. `blockers` softly hide parts of a lamp's ball; a blocker that touches the lamp holds it and
// hides nothing. A lamp's walls hide it too.
void AddLamps(std::span<const Lamp> lamps,
              const Points& receivers,
              const ShRows& own_log,
              const Spheres& blockers,
              ReceiverRange range,
              ShRowsRgb& radiance);

// Factor on a flame's brightness at a time in seconds: smooth noise about 1 with about 2 to 11
// changes a second; equal seeds give equal noise. amount: 0 is steady, 1 is wild.
float Flicker(uint64_t seed, double time, float amount);

// Colour of a black body in linear sRGB with luminance 1: the Planckian locus by the cubics of Kim
// et al. (US patent 7024034, 2006). kelvin is clamped to 1667..25000.
glm::vec3 ColourOfTemperature(double kelvin);

}  // namespace lararium::light
