#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "shared/human/level_of_detail.h"

namespace lararium::import {

// Number of levels coarser than the mesh itself. Files that were baked with another number are
// rebuilt.
inline constexpr int kLevelsOfDetail = 6;

// Gives up to six coarser levels of the given triangles, with about a half to a 64th of `whole`
// indices. Collapses edges and keeps texture seams and open borders together (quadric error;
// Garland & Heckbert, SIGGRAPH 1997). If this stops early, for example at the many pieces of a
// set of teeth, vertices are clustered in a grid instead (Rossignac & Borrel 1993). Leaves out
// levels that save little over the previous one.
std::vector<human::LevelOfDetail> CoarserLevels(std::span<const glm::vec3> positions,
                                                std::span<const uint32_t> indices,
                                                size_t whole);

// Reorders the triangles for the vertex cache.
void OrderForCache(size_t vertex_count, std::vector<uint32_t>& indices);

// Mean length of the edges of all triangles in metres; an edge counts once per triangle. 0 if
// there are none.
float MeanEdge(std::span<const glm::vec3> positions, std::span<const uint32_t> indices);

}  // namespace lararium::import
