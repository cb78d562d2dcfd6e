#pragma once

// Approximates the light on a real surface by a few cones about its normal, each with an equal
// share of the cosine-weighted hemisphere. A closed formula says how much of a cone a ball hides.
// Private to render.

#include <array>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "shared/light/spherical_harmonics.h"

namespace lararium::render {

// Must agree with shaders/pass/sky_ratio.frag. Compared with the path-traced floor of the lighting
// set, the RMS error of the ratio was 0.040 with 16 cones, 0.035 with 24 and 0.034 with 48.
inline constexpr int kSkyConeCount = 24;

// The common axis of the cones before a shader mirrors them onto a normal. For normals near this
// axis the pattern turns quickly from one to the next, so the axis is a direction that few
// surfaces have as their normal.
glm::vec3 SkyConeAxis();

// Directions (xyz) and cosines of half the opening angle (w): a spiral (Vogel 1979) that gives
// every cone an equal share of the projected solid angle.
const std::array<glm::vec4, kSkyConeCount>& SkyCones();

// Radiance averaged over such a cone for all directions, clamped to non-negative values: an
// octahedral map about +Y (Engelhardt & Dachsbacher, "Octahedron Environment Maps", VMV 2008).
// radiance: kSkyMapSize x kSkyMapSize texels, [row][column], alpha 1.
inline constexpr int kSkyMapSize = 24;
void FillSkyMap(const light::ShRgb& light, std::vector<glm::vec4>& radiance);
// Irradiance indexed by normal, in a map of the same layout.
void FillIrradianceMap(const light::ShRgb& light, std::vector<glm::vec4>& irradiance);

}  // namespace lararium::render
