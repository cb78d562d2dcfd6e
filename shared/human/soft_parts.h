#pragma once

// Parts of a person that are simulated (cloth and hair), and the capsules of the body that they
// collide with.

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <string>
#include <vector>

#include "shared/core/status.h"

namespace lararium::human {

struct SkinnedMesh;

// A cone with round ends, attached to a joint, which cloth and hair cannot enter.
struct BodyCapsule {
  uint32_t joint = 0;
  glm::vec3 a = glm::vec3(0.0f);  // metres, joint frame
  glm::vec3 b = glm::vec3(0.0f);
  float radius_a = 0.05f;  // metres
  float radius_b = 0.05f;

  Status Validate(size_t joint_count, const std::string& where) const;
};

// A simulated sheet of particles and the drawn mesh that follows it. The particle arrays are
// parallel and describe the bind pose: metres, actor frame.
struct Cloth {
  static constexpr uint32_t kUnbound = 0xffffffffu;

  std::string name;
  uint32_t mesh = 0;  // Index into Human::meshes: the mesh that follows the particles.

  std::vector<glm::vec3> positions;
  std::vector<std::array<uint8_t, 4>> joints;  // influences of a particle under plain skinning
  std::vector<glm::vec4> weights;
  std::vector<float> reach;  // Metres that a particle may move from its plain skin; 0 pins it.
  std::vector<uint32_t> triangles;  // three particles each

  // For each vertex of the mesh: the triangle of particles that it follows (kUnbound: plain skin),
  // the weights of that triangle's first two corners, and the offset in metres along the triangle's
  // normal.
  std::vector<uint32_t> vertex_triangle;
  std::vector<glm::vec3> vertex_weights;

  float density = 0.25f;             // kg/m^2
  float stretch_compliance = 1e-7f;  // m/N, for an edge (XPBD)
  float bend_compliance = 400.0f;    // rad/(N m), for a hinge of equilateral triangles
  float friction = 0.4f;             // coefficient against body and floor
  float thickness = 0.006f;          // metres kept from the body

  Status Validate(const std::vector<SkinnedMesh>& meshes,
                  size_t joint_count,
                  const std::string& where) const;
};

// A chain of joints that swings behind its parent: hair, tassels, ends of belts.
struct SpringChain {
  std::string name;
  std::vector<uint32_t> joints;  // Each joint is the parent of the next.
  float stiffness = 4.0f;        // 1/s^2 towards the animated pose, per radian
  float drag = 3.0f;             // 1/s
  float gravity = 1.0f;          // factor on 9.81 m/s^2
  float radius = 0.02f;          // metres kept from the body

  Status Validate(const std::vector<int16_t>& parents, const std::string& where) const;
};

}  // namespace lararium::human
