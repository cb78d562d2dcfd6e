#pragma once

// Moves vertices from the bind pose with the joints: what the GPU does when it
// draws, here for tests, bounds and baking.

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

// The skin matrices of a pose; for baking and tests, which may allocate.
std::vector<glm::mat4> SkinOfPose(const Skeleton& skeleton, std::span<const JointTransform> pose);

// A rigid motion after one scale: x -> rotation * (scale * x) + translation, as the
// unit dual quaternion real + e dual, dual = translation * real / 2.
struct DualQuaternion {
  glm::quat real = glm::quat(1.0f, 0.0f, 0.0f, 0.0f);
  glm::quat dual = glm::quat(0.0f, 0.0f, 0.0f, 0.0f);
  float scale = 1.0f;
};

// Of a skin matrix. A scale that differs along the axes becomes their mean, shear is
// left out.
DualQuaternion ToDualQuaternion(const glm::mat4& matrix);

// Skins vertices, four influences each.
//
// kLinear: the weighted mean of the matrices. kDualQuaternion: the normalised
// weighted sum of dual quaternions, on the side of the first, after the weighted mean
// of the scales; joints keep their volume where linear blending collapses it (Kavan,
// Collins, Zara & O'Sullivan, "Geometric Skinning with Approximate Dual Quaternion
// Blending", ACM TOG 27(4), 2008, algorithm 1).
//
// Frame: bind pose to actor, metres. Arrays are parallel over the vertices; results
// must not overlap inputs. Normals come out as unit vectors. Allocates nothing.
struct SkinningJob {
  std::span<const glm::vec3> bind_positions;
  std::span<const glm::vec3> bind_normals;
  std::span<const std::array<uint8_t, 4>> joints;
  std::span<const glm::vec4> weights;
  std::span<const glm::mat4> skin;  // ComputeSkinMatrices
  Skinning skinning = Skinning::kLinear;
  std::span<glm::vec3> positions;
  std::span<glm::vec3> normals;

  void Run() const;
};

// The whole mesh as the file has it.
void SkinMesh(const SkinnedMesh& mesh,
              std::span<const glm::mat4> skin,
              std::span<glm::vec3> positions,
              std::span<glm::vec3> normals,
              Skinning skinning = Skinning::kLinear);

}  // namespace lararium::human
