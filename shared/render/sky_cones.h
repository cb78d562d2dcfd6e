#pragma once

// The light on a real surface as that of a few cones about its normal, each with an equal
// share of the cosine: what a ball hides of a cone is a formula. Private to render.

#include <array>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "shared/light/spherical_harmonics.h"

namespace lararium::render {

// As shaders/pass/sky_ratio.frag has it. Against the path-traced floor of the lighting
// set the ratio was off by 0.040 (root mean square) with 16, 0.035 with 24, 0.034 with 48.
inline constexpr int kSkyConeCount = 24;

// Which way the cones' common axis points before a shader mirrors them onto a normal;
// about that one normal the pattern turns quickly, so it is one that few surfaces have.
glm::vec3 SkyConeAxis();

// Directions, and cosines of half the opening angle: a spiral (Vogel 1979) of which every
// cone gets an equal share of the projected solid angle.
const std::array<glm::vec4, kSkyConeCount>& SkyCones();

// Radiance averaged over such a cone, for all directions: an octahedral map about +Y
// (Engelhardt & Dachsbacher, "Octahedron Environment Maps", VMV 2008), never negative.
// radiance: [row][column] of kSkyMapSize, alpha 1.
inline constexpr int kSkyMapSize = 24;
void FillSkyMap(const light::ShRgb& light, std::vector<glm::vec4>& radiance);
// The same of irradiance, by normal.
void FillIrradianceMap(const light::ShRgb& light, std::vector<glm::vec4>& irradiance);

}  // namespace lararium::render
