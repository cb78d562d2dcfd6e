#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>

namespace lararium::render {

// True when the triangles bound a volume and face outwards: every edge is used
// equally often in both directions (vertices at one position count as one). Back
// faces of such a surface are never seen and need be neither drawn nor lit.
bool IsClosedSurface(std::span<const glm::vec3> positions, std::span<const uint32_t> indices);

}  // namespace lararium::render
