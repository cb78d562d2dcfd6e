#include "editor/import/objects/paint.h"

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace lararium::import {
namespace {

// A value of -1..1 for a lattice point: integer finaliser of MurmurHash3.
float LatticeValue(const glm::ivec3& p, uint32_t seed) {
  uint32_t h = seed * 0x9e3779b9u ^ static_cast<uint32_t>(p.x) * 0x8da6b343u ^
               static_cast<uint32_t>(p.y) * 0xd8163841u ^ static_cast<uint32_t>(p.z) * 0xcb1ab31fu;
  h = (h ^ (h >> 16)) * 0x85ebca6bu;
  h = (h ^ (h >> 13)) * 0xc2b2ae35u;
  h ^= h >> 16;
  return static_cast<float>(h) * (2.0f / 4294967295.0f) - 1.0f;
}

// 0 below low, 1 above high.
float Ramp(float value, float low, float high) { return glm::smoothstep(low, high, value); }

glm::vec3 Shade(const glm::vec3& colour, float factor) {
  return glm::clamp(colour * factor, 0.0f, 1.0f);
}

}  // namespace

float ValueNoise(const glm::vec3& point, uint32_t seed) {
  const glm::vec3 cell = glm::floor(point);
  const glm::vec3 t = point - cell;
  const glm::vec3 s = t * t * (3.0f - 2.0f * t);
  const glm::ivec3 corner(cell);
  float sum = 0.0f;
  for (int k = 0; k < 8; ++k) {
    const glm::ivec3 step(k & 1, (k >> 1) & 1, k >> 2);
    const glm::vec3 weight = glm::mix(1.0f - s, s, glm::vec3(step));
    sum += weight.x * weight.y * weight.z * LatticeValue(corner + step, seed);
  }
  return sum;
}

float FractalNoise(const glm::vec3& point, uint32_t seed) {
  float sum = 0.0f;
  float strength = 0.5f;
  float frequency = 1.0f;
  for (uint32_t octave = 0; octave < 4; ++octave) {
    sum += strength * ValueNoise(frequency * point, seed + octave);
    strength *= 0.5f;
    frequency *= 2.0f;
  }
  return sum;
}

Paint PlainPaint(const glm::vec3& colour) {
  return [colour](const glm::vec3&) { return colour; };
}

Paint ClayPaint(const glm::vec3& colour, uint32_t seed) {
  return [=](const glm::vec3& p) {
    const float cloud = FractalNoise(9.0f * p, seed);
    const float wheel = ValueNoise(glm::vec3(0.0f, 180.0f * p.y, 0.0f), seed + 7);
    const float soot = Ramp(FractalNoise(5.0f * p, seed + 11), 0.25f, 0.7f);
    return Shade(colour, (1.0f + 0.28f * cloud + 0.05f * wheel) * (1.0f - 0.35f * soot));
  };
}

Paint WoodPaint(const glm::vec3& colour, int grain_axis, uint32_t seed) {
  return [=](const glm::vec3& p) {
    glm::vec3 stretched = 55.0f * p;
    stretched[grain_axis] *= 0.06f;
    const float grain = FractalNoise(stretched, seed);
    const float wear = FractalNoise(6.0f * p, seed + 5);
    return Shade(colour, 1.0f + 0.38f * grain + 0.18f * wear);
  };
}

Paint MetalPaint(const glm::vec3& metal, const glm::vec3& patina, uint32_t seed) {
  return [=](const glm::vec3& p) {
    const float spread = Ramp(FractalNoise(22.0f * p, seed), -0.25f, 0.35f);
    return Shade(glm::mix(metal, patina, spread), 1.0f + 0.15f * FractalNoise(70.0f * p, seed + 3));
  };
}

Paint CrustPaint(const glm::vec3& crumb, const glm::vec3& crust, float height, uint32_t seed) {
  return [=](const glm::vec3& p) {
    const float baked = Ramp(p.y / height + 0.35f * FractalNoise(30.0f * p, seed), 0.15f, 0.9f);
    return Shade(glm::mix(crumb, crust, baked), 1.0f + 0.2f * FractalNoise(90.0f * p, seed + 2));
  };
}

Paint StonePaint(const glm::vec3& colour, uint32_t seed) {
  return [=](const glm::vec3& p) {
    const float grain = FractalNoise(120.0f * p, seed);
    return Shade(colour, 1.0f + 0.3f * grain + 0.15f * FractalNoise(12.0f * p, seed + 4));
  };
}

}  // namespace lararium::import
