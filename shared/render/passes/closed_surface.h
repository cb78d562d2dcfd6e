#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>

namespace lararium::render {

// True if the triangles bound a volume and face outwards: every edge is used equally often in both
// directions (vertices at the same position count as one). Back faces of such a surface are never
// visible, so they need not be drawn or lit.
bool IsClosedSurface(std::span<const glm::vec3> positions, std::span<const uint32_t> indices);

}  // namespace lararium::render
