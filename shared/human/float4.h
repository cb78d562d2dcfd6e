#pragma once

// Four floats in one register: a 3-vector and a lane that is zero. The loops over the cloth's
// constraints access particles by index; one particle in each register avoids gathers and scatters.

#include <cmath>
#include <glm/vec3.hpp>

namespace lararium::human {

struct Float4 {
  using Lanes = float __attribute__((vector_size(16)));

  Lanes lanes = {0.0f, 0.0f, 0.0f, 0.0f};

  Float4() = default;
  explicit Float4(Lanes value) : lanes(value) {}
  explicit Float4(const glm::vec3& v) : lanes{v.x, v.y, v.z, 0.0f} {}

  glm::vec3 xyz() const { return {lanes[0], lanes[1], lanes[2]}; }
  float y() const { return lanes[1]; }

  Float4& operator+=(const Float4& o) { return lanes += o.lanes, *this; }
  Float4& operator-=(const Float4& o) { return lanes -= o.lanes, *this; }
};

inline Float4 operator+(const Float4& a, const Float4& b) { return Float4(a.lanes + b.lanes); }
inline Float4 operator-(const Float4& a, const Float4& b) { return Float4(a.lanes - b.lanes); }
inline Float4 operator*(const Float4& a, float s) { return Float4(a.lanes * s); }
inline Float4 operator*(float s, const Float4& a) { return Float4(a.lanes * s); }

inline float Dot(const Float4& a, const Float4& b) {
  const Float4::Lanes p = a.lanes * b.lanes;
  const Float4::Lanes halves = p + __builtin_shufflevector(p, p, 2, 3, 0, 1);
  return halves[0] + halves[1];
}

inline float Length(const Float4& a) { return std::sqrt(Dot(a, a)); }

inline Float4 Mix(const Float4& a, const Float4& b, float share) { return a + (b - a) * share; }

inline Float4 Cross(const Float4& a, const Float4& b) {
  const Float4::Lanes a_yzx = __builtin_shufflevector(a.lanes, a.lanes, 1, 2, 0, 3);
  const Float4::Lanes b_yzx = __builtin_shufflevector(b.lanes, b.lanes, 1, 2, 0, 3);
  const Float4::Lanes zxy = a.lanes * b_yzx - a_yzx * b.lanes;
  return Float4(__builtin_shufflevector(zxy, zxy, 1, 2, 0, 3));
}

}  // namespace lararium::human
