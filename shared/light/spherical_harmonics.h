#pragma once

// Real spherical harmonics, degrees 0..2 (9 coefficients), index l(l+1)+m, in
// stage axes (Y up): Ramamoorthi & Hanrahan, "An Efficient Representation for
// Irradiance Environment Maps", SIGGRAPH 2001. No Condon-Shortley phase.

#include <array>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <span>

namespace lararium::light {

inline constexpr int kShCount = 9;
// One RGB coefficient for each basis function: radiance, linear.
using ShRgb = std::array<glm::vec3, kShCount>;

// The basis functions at a unit direction.
std::array<float, kShCount> EvaluateShBasis(const glm::vec3& direction);

// Radiance from a direction.
glm::vec3 EvaluateRadiance(const ShRgb& radiance, const glm::vec3& direction);

// Irradiance on a surface with a unit normal: convolution with the clamped
// cosine (pi, 2 pi / 3, pi / 4), never negative.
glm::vec3 EvaluateIrradiance(const ShRgb& radiance, const glm::vec3& normal);

// The light seen from a frame turned by rotation: coefficients of f(rotation^-1 d).
ShRgb RotateSh(const ShRgb& radiance, const glm::quat& rotation);

// Projects an equirectangular image of radiance, solid-angle weighted. Pixel
// (column, row) is the direction of azimuth 2 pi ((column + 0.5) / width - 0.5)
// from -Z towards +X and elevation pi (0.5 - (row + 0.5) / height): the image
// centre looks along -Z, the top row is the zenith (docs/file-formats.md).
ShRgb ProjectEquirectangular(std::span<const glm::vec3> pixels, int width, int height);

}  // namespace lararium::light
