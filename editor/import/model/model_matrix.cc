#include "editor/import/model/model_matrix.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "shared/human/finite.h"

namespace lararium::import {

bool IsUsable(const glm::mat4& matrix) {
  const float determinant = glm::determinant(glm::mat3(matrix));
  return human::Finite(matrix) && std::isfinite(determinant) && std::abs(determinant) > 1e-20f &&
         matrix[0].w == 0.0f && matrix[1].w == 0.0f && matrix[2].w == 0.0f && matrix[3].w == 1.0f;
}

glm::vec3 Apply(const glm::mat4& matrix, const glm::vec3& point) {
  return glm::vec3(matrix * glm::vec4(point, 1.0f));
}

float ScaleOf(const glm::mat4& matrix) {
  return std::cbrt(std::abs(glm::determinant(glm::mat3(matrix))));
}

human::JointTransform Decompose(const glm::mat4& matrix) {
  human::JointTransform result;
  result.translation = glm::vec3(matrix[3]);
  result.scale = glm::vec3(ScaleOf(matrix));
  const glm::vec3 x = glm::vec3(matrix[0]);
  const glm::vec3 z = glm::cross(x, glm::vec3(matrix[1]));
  const bool flat = !(glm::length(x) > 1e-12f) || !(glm::length(z) > 1e-12f);
  if (!flat && glm::determinant(glm::mat3(matrix)) > 0.0f) {
    const glm::vec3 ux = glm::normalize(x), uz = glm::normalize(z);
    result.rotation = glm::normalize(glm::quat_cast(glm::mat3(ux, glm::cross(uz, ux), uz)));
  }
  return result;
}

glm::vec3 Unit(const glm::vec3& vector) {
  const float length = glm::length(vector);
  return length > 1e-12f && std::isfinite(length) ? vector / length : glm::vec3(0.0f, 1.0f, 0.0f);
}

}  // namespace lararium::import
