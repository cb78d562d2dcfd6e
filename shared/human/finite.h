#pragma once

// Checks of numbers that come from files.

#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "shared/human/skeleton.h"

namespace lararium::human {

inline bool Finite(const glm::vec2& v) { return std::isfinite(v.x) && std::isfinite(v.y); }

inline bool Finite(const glm::vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

inline bool Finite(const glm::vec4& v) { return Finite(glm::vec3(v)) && std::isfinite(v.w); }

inline bool Finite(const glm::mat4& m) {
  return Finite(m[0]) && Finite(m[1]) && Finite(m[2]) && Finite(m[3]);
}

// True if all values are finite and the rotation has unit length within the precision of floats in
// files.
inline bool Valid(const JointTransform& transform) {
  const float length = glm::length(transform.rotation);
  return std::abs(length - 1.0f) < 1e-3f && Finite(transform.translation) &&
         Finite(transform.scale);
}

}  // namespace lararium::human
