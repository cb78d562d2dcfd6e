#pragma once

// Rotations about named axes, for code that poses bodies. Actor axes: X right, Y up, -Z forward.

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include "shared/core/units.h"

namespace lararium::human {

// Positive angles: X raises what is in front, Y turns to the left, Z raises the right side.
inline glm::quat TurnX(float angle) {
  return {std::cos(0.5f * angle), std::sin(0.5f * angle), 0.0f, 0.0f};
}
inline glm::quat TurnY(float angle) {
  return {std::cos(0.5f * angle), 0.0f, std::sin(0.5f * angle), 0.0f};
}
inline glm::quat TurnZ(float angle) {
  return {std::cos(0.5f * angle), 0.0f, 0.0f, std::sin(0.5f * angle)};
}

inline const glm::quat kNoTurn(1.0f, 0.0f, 0.0f, 0.0f);

// Returns v normalised, or `instead` if v has no length.
inline glm::vec3 Direction(const glm::vec3& v, const glm::vec3& instead) {
  const float length = glm::length(v);
  return length > 1e-6f ? v / length : instead;
}

// Returns the component of v perpendicular to a unit axis.
inline glm::vec3 Across(const glm::vec3& v, const glm::vec3& axis) {
  return v - glm::dot(v, axis) * axis;
}

// Returns any unit vector perpendicular to a unit axis.
inline glm::vec3 AnyAcross(const glm::vec3& axis) {
  const glm::vec3 other = std::abs(axis.x) < 0.7f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
  return glm::normalize(glm::cross(axis, other));
}

// The shortest turn between two unit vectors.
inline glm::quat Arc(const glm::vec3& from, const glm::vec3& to) {
  const float cosine = glm::dot(from, to);
  if (cosine < -0.9999f) {
    const glm::vec3 axis = AnyAcross(from);
    return {0.0f, axis.x, axis.y, axis.z};
  }
  const glm::vec3 axis = glm::cross(from, to);
  return glm::normalize(glm::quat(1.0f + cosine, axis.x, axis.y, axis.z));
}

// Returns the rotation about a vector whose length is the angle in radians.
inline glm::quat TurnBy(const glm::vec3& rotation) {
  const float angle = glm::length(rotation);
  return angle > 1e-9f ? glm::angleAxis(angle, rotation / angle) : kNoTurn;
}

// Returns a share of a rotation along the shorter arc.
inline glm::quat Share(const glm::quat& turn, float share) {
  return glm::slerp(kNoTurn, turn, share);
}

inline glm::quat ShorterArc(const glm::quat& turn) { return turn.w < 0.0f ? -turn : turn; }

// The angle of a turn about a unit axis (swing and twist), -pi..pi.
inline float TwistAngle(const glm::quat& turn, const glm::vec3& axis) {
  const glm::quat q = ShorterArc(turn);
  return 2.0f * std::atan2(glm::dot(glm::vec3(q.x, q.y, q.z), axis), q.w);
}

// Interpolates from a to b the shorter way around.
inline float MixAngles(float a, float b, float alpha) {
  return a + alpha * std::remainder(b - a, 2.0f * kPiF);
}

// Returns the share of the remaining distance that an exponential approach with this time constant
// covers in one step.
inline float Approach(float seconds, float time_constant) {
  return 1.0f - std::exp(-seconds / time_constant);
}

}  // namespace lararium::human
