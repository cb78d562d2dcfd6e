#pragma once

// Small lights on the stage: flames and embers as balls of even radiance. A receiver sees a
// lamp as a disc, whose harmonics are zonal and so a formula (Sloan, "Stupid Spherical
// Harmonics (SH) Tricks", GDC 2008, "Analytic Light Sources"). Stage axes, metres. Nothing
// allocates.

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
  // Linear RGB irradiance of a surface one metre away that faces it: pi times its radiance
  // times its radius squared.
  glm::vec3 intensity = glm::vec3(0.0f);
  float radius = 0.05f;
  // What of the place stands in its light; nullptr: nothing does.
  std::shared_ptr<const LampWalls> walls = nullptr;
};

// The most that a picture has; the brightest are taken.
inline constexpr size_t kMaxLamps = 8;
// Nearer than this many radii a lamp is no brighter.
inline constexpr float kNearestLamp = 1.02f;

// As it is seen from a point.
Sun SeenFrom(const Lamp& lamp, const glm::vec3& point);

// Metres beyond which a lamp gives a facing surface less than an irradiance.
float ReachOf(const Lamp& lamp, float irradiance);

// Adds the lamps' radiance to the receivers of range: rows of the count of own_log, 9, 16 or
// 25. own_log: log visibility past what the lamps do not know of (the receivers' own body);
// its value towards a lamp dims it. blockers: hide parts of the lamp's ball, softly, where
// they stand between; those that touch the lamp hold it and hide nothing. A lamp's walls hide it
// too.
void AddLamps(std::span<const Lamp> lamps,
              const Points& receivers,
              const ShRows& own_log,
              const Spheres& blockers,
              ReceiverRange range,
              ShRowsRgb& radiance);

// What a flame's brightness is multiplied with at a time (seconds): smooth noise about 1, of
// some 2 to 11 changes a second, the same for the same seed. amount: 0 steady, 1 wild.
float Flicker(uint64_t seed, double time, float amount);

// The colour of a glowing body, linear sRGB of luminance 1: the Planckian locus by the cubics
// of Kim et al. (US patent 7024034, 2006). kelvin: clamped to 1667..25000.
glm::vec3 ColourOfTemperature(double kelvin);

}  // namespace lararium::light
