#pragma once

// The skeleton of a person of the cast: the library's 163 bones brought down to the
// joints that motion uses, with H-Anim's names. What moves with the face's skin alone
// (its muscles) is left to morph targets: those bones' weights go to head and jaw.

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "editor/import/cast_body.h"
#include "editor/import/cast_library.h"
#include "shared/core/status.h"

namespace lararium::import {

// Joints at the places that positions (every base vertex, metres, actor frame) give
// them; frames are parallel to the actor's. Fails where the library's rig lacks a bone.
Result<human::Skeleton> CastSkeleton(const CastLibrary& library,
                                     std::span<const glm::vec3> positions);

// Of every base vertex, the joints of CastSkeleton that move it.
struct CastWeights {
  std::vector<std::array<uint8_t, 4>> joints;
  std::vector<glm::vec4> weights;
};
CastWeights WeightsOf(const CastLibrary& library, const human::Skeleton& skeleton);

// The four strongest of several weighted influences, summing to 1.
struct Influences {
  std::array<uint8_t, 4> joints{};
  glm::vec4 weights{1.0f, 0.0f, 0.0f, 0.0f};
};
Influences Strongest(std::span<const std::pair<uint8_t, float>> influences);

}  // namespace lararium::import
