#pragma once

// The skeleton of a person of the cast: the 163 bones of the library reduced to the joints that
// motion uses, with H-Anim names. Bones that only move the skin of the face (its muscles) are
// replaced by morph targets; their weights go to head and jaw.

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "editor/import/cast/cast_body.h"
#include "editor/import/cast/cast_library.h"
#include "shared/core/status.h"

namespace lararium::import {

// Places the joints from `positions` (all base vertices, metres, actor frame); frames are
// parallel to the actor's. Fails if the rig of the library lacks a bone.
Result<human::Skeleton> CastSkeleton(const CastLibrary& library,
                                     std::span<const glm::vec3> positions);

// For each base vertex, the joints of CastSkeleton that move it.
struct CastWeights {
  std::vector<std::array<uint8_t, 4>> joints;
  std::vector<glm::vec4> weights;
};
CastWeights WeightsOf(const CastLibrary& library, const human::Skeleton& skeleton);

// The four strongest of several weighted influences; the weights sum to 1.
struct Influences {
  std::array<uint8_t, 4> joints{};
  glm::vec4 weights{1.0f, 0.0f, 0.0f, 0.0f};
};
Influences Strongest(std::span<const std::pair<uint8_t, float>> influences);

}  // namespace lararium::import
