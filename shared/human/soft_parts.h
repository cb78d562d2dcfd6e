#pragma once

// Parts of a person that move by themselves: cloth, hair, and the body that they
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

// A cone with round ends that belongs to a joint: what cloth and hair cannot enter.
struct BodyCapsule {
  uint32_t joint = 0;
  glm::vec3 a = glm::vec3(0.0f);  // metres, joint frame
  glm::vec3 b = glm::vec3(0.0f);
  float radius_a = 0.05f;  // metres
  float radius_b = 0.05f;

  Status Validate(size_t joint_count, const std::string& place) const;
};

// A simulated sheet of particles and the drawn mesh that follows it. Particle arrays
// are parallel, in the bind pose, metres, actor frame.
struct Cloth {
  static constexpr uint32_t kUnbound = 0xffffffffu;

  std::string name;
  uint32_t mesh = 0;  // index into Human::meshes: what follows

  std::vector<glm::vec3> positions;
  std::vector<std::array<uint8_t, 4>> joints;  // where a particle would be as plain skin
  std::vector<glm::vec4> weights;
  std::vector<float> reach;         // metres that it may be from there; 0 pins it
  std::vector<uint32_t> triangles;  // three particles each

  // Of each vertex of the mesh: the triangle of particles that it follows (kUnbound:
  // plain skin), the weights of that triangle's first two corners, and the offset in
  // metres along the triangle's normal.
  std::vector<uint32_t> vertex_triangle;
  std::vector<glm::vec3> vertex_weights;

  float density = 0.25f;             // kg/m^2
  float stretch_compliance = 1e-7f;  // m/N, of an edge (XPBD)
  float bend_compliance = 400.0f;    // rad/(N m), of a hinge of equilateral triangles
  float friction = 0.4f;             // against body and floor
  float thickness = 0.006f;          // metres, kept from the body

  Status Validate(const std::vector<SkinnedMesh>& meshes,
                  size_t joint_count,
                  const std::string& place) const;
};

// Joints that swing behind their parent: hair, tassels, ends of belts.
struct SpringChain {
  std::string name;
  std::vector<uint32_t> joints;  // from the root outward, each the parent of the next
  float stiffness = 4.0f;        // 1/s^2 towards the animated pose, per radian
  float drag = 3.0f;             // 1/s
  float gravity = 1.0f;          // of 9.81 m/s^2
  float radius = 0.02f;          // metres, kept from the body

  Status Validate(const std::vector<int16_t>& parents, const std::string& place) const;
};

}  // namespace lararium::human
