#pragma once

// Conversions between Eigen's and GLM's types; no other file has them.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "shared/geometry/transform.h"

namespace lararium::geometry {

inline glm::vec3 ToGlm(const Eigen::Vector3d& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}
inline Eigen::Vector3d ToEigen(const glm::vec3& v) { return {v.x, v.y, v.z}; }

inline glm::quat ToGlm(const Eigen::Quaterniond& q) {
  return {static_cast<float>(q.w()), static_cast<float>(q.x()), static_cast<float>(q.y()),
          static_cast<float>(q.z())};
}
inline Eigen::Quaterniond ToEigen(const glm::quat& q) { return {q.w, q.x, q.y, q.z}; }

inline glm::mat4 ToGlm(const Similarity3& a_from_b) {
  glm::mat4 matrix = glm::mat4_cast(ToGlm(a_from_b.rotation));
  for (int column = 0; column < 3; ++column) {
    matrix[column] *= static_cast<float>(a_from_b.scale);
  }
  matrix[3] = glm::vec4(ToGlm(a_from_b.translation), 1.0f);
  return matrix;
}
inline glm::mat4 ToGlm(const Rigid3& a_from_b) {
  return ToGlm(Similarity3{1.0, a_from_b.rotation, a_from_b.translation});
}

}  // namespace lararium::geometry
