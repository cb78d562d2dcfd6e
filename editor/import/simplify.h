#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "shared/human/level_of_detail.h"

namespace lararium::import {

// Coarser than a mesh itself; files that were made with another number are made anew.
inline constexpr int kLevelsOfDetail = 6;

// Up to six coarser levels of some triangles, of about a half to a 64th of `whole` indices, by edge
// collapses that keep texture seams and open borders together (quadric error; Garland & Heckbert,
// SIGGRAPH 1997). Where these stop early, as at the many pieces of a set of teeth, vertices are
// clustered in a grid instead (Rossignac & Borrel 1993). A level that saves little over the one
// before is left out.
std::vector<human::LevelOfDetail> CoarserLevels(std::span<const glm::vec3> positions,
                                                std::span<const uint32_t> indices,
                                                size_t whole);

// Puts triangles into an order that finds its vertices in the cache.
void OrderForCache(size_t vertex_count, std::vector<uint32_t>& indices);

// Metres, of all edges, each as often as triangles have it; 0 where there are none.
float MeanEdge(std::span<const glm::vec3> positions, std::span<const uint32_t> indices);

}  // namespace lararium::import
