#pragma once

// Moves vertices from the bind pose with the joints, as the GPU does when it draws. For tests,
// bounds and baking.

#include <array>
#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "shared/human/human.h"

namespace lararium::human {

// Returns the skin matrices of a pose. Allocates; for baking and tests.
std::vector<glm::mat4> SkinOfPose(const Skeleton& skeleton, std::span<const JointTransform> pose);

// A rigid motion after a uniform scale: x -> rotation * (scale * x) + translation, as the unit dual
// quaternion real + e dual, where dual = translation * real / 2.
struct DualQuaternion {
  glm::quat real = glm::quat(1.0f, 0.0f, 0.0f, 0.0f);
  glm::quat dual = glm::quat(0.0f, 0.0f, 0.0f, 0.0f);
  float scale = 1.0f;
};

// Converts a skin matrix. A non-uniform scale becomes its mean; shear is dropped.
DualQuaternion ToDualQuaternion(const glm::mat4& matrix);

// Skins vertices with four influences each.
//
// kLinear: the weighted mean of the matrices. kDualQuaternion: the normalised weighted sum of dual
// quaternions, with signs matched to the first, after the weighted mean of the scales. Joints keep
// their volume where linear blending collapses it (Kavan, Collins, Zara & O'Sullivan, "Geometric
// Skinning with Approximate Dual Quaternion Blending", ACM TOG 27(4), 2008, algorithm 1).
//
// Frame: from the bind pose to the actor frame, metres. Arrays are parallel over the vertices;
// results must not overlap inputs. Normals are unit vectors. Allocates nothing.
struct SkinningJob {
  std::span<const glm::vec3> bind_positions;
  std::span<const glm::vec3> bind_normals;
  std::span<const std::array<uint8_t, 4>> joints;
  std::span<const glm::vec4> weights;
  std::span<const glm::mat4> skin;  // result of ComputeSkinMatrices
  Skinning skinning = Skinning::kLinear;
  std::span<glm::vec3> positions;
  std::span<glm::vec3> normals;

  void Run() const;
};

// Skins the whole mesh without morph targets.
void SkinMesh(const SkinnedMesh& mesh,
              std::span<const glm::mat4> skin,
              std::span<glm::vec3> positions,
              std::span<glm::vec3> normals,
              Skinning skinning = Skinning::kLinear);

}  // namespace lararium::human
