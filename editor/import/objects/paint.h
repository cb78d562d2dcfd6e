#pragma once

// Colours of materials that vary over a surface: albedo as a function of a point of the object,
// linear RGB. Made of deterministic noise.

#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>

namespace lararium::import {

// Smooth noise of lattice values, about -1..1, with features about one unit wide.
float ValueNoise(const glm::vec3& point, uint32_t seed);
// Four octaves of ValueNoise, each with half the size and half the strength of the previous
// one.
float FractalNoise(const glm::vec3& point, uint32_t seed);

using Paint = std::function<glm::vec3(const glm::vec3& point)>;

Paint PlainPaint(const glm::vec3& colour);
// Fired clay: cloudy from the kiln, with faint rings from the wheel.
Paint ClayPaint(const glm::vec3& colour, uint32_t seed);
// Grain along an axis of the object: 0 x, 1 y, 2 z.
Paint WoodPaint(const glm::vec3& colour, int grain_axis, uint32_t seed);
// Metal in use: bare where it is rubbed, patina elsewhere.
Paint MetalPaint(const glm::vec3& metal, const glm::vec3& patina, uint32_t seed);
// A crust that is darker at its highest points.
Paint CrustPaint(const glm::vec3& crumb, const glm::vec3& crust, float height, uint32_t seed);
Paint StonePaint(const glm::vec3& colour, uint32_t seed);

}  // namespace lararium::import
