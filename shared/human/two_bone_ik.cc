#include "shared/human/two_bone_ik.h"

#include <algorithm>
#include <cmath>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "shared/human/turns.h"

namespace lararium::human {
namespace {

// Axes of a frame along a segment and its hinge.
glm::mat3 Basis(const glm::vec3& along, const glm::vec3& hinge) {
  const glm::vec3 h = Direction(Across(hinge, along), AnyAcross(along));
  return glm::mat3(h, along, glm::cross(h, along));
}

float SoftDistance(float distance, float length) {
  const float exact = TwoBoneIk::kExact * length;
  if (distance <= exact) {
    return distance;
  }
  const float rest = 0.9999f * length - exact;
  return exact + rest * (1.0f - std::exp(-(distance - exact) / rest));
}

}  // namespace

float TwoBoneIk::Solve(const Skeleton& skeleton,
                       const BodyRig& body,
                       std::span<JointTransform> pose) const {
  const JointFrame upper_frame = ActorFromJoint(skeleton, pose, upper);
  const glm::vec3 a = upper_frame.position;
  const glm::vec3 b = ActorFromJoint(skeleton, pose, lower).position;
  const glm::vec3 c = ActorFromJoint(skeleton, pose, end).position;
  const float first = glm::distance(a, b);
  const float second = glm::distance(b, c);
  if (first < 1e-5f || second < 1e-5f) {
    return glm::distance(c, target);
  }
  const glm::vec3 old_first = (b - a) / first;
  const glm::vec3 old_second = (c - b) / second;
  const glm::vec3 direction = Direction(target - a, old_first);
  const float shortest = std::abs(first - second) + 1e-4f;
  const float distance = std::max(SoftDistance(glm::distance(target, a), first + second), shortest);
  const float along = (first * first - second * second + distance * distance) / (2.0f * distance);
  const float aside = std::sqrt(std::max(first * first - along * along, 0.0f));
  const glm::vec3 bend = Direction(Across(pole, direction), AnyAcross(direction));
  const glm::vec3 new_first = (along * direction + aside * bend) / first;
  const glm::vec3 new_second = ((distance - along) * direction - aside * bend) / second;

  // The limb's current hinge: the axis of its bend, or the rest axis carried along if it is
  // straight.
  const size_t u = static_cast<size_t>(upper);
  const glm::vec3 carried = upper_frame.rotation * (glm::inverse(body.rest[u].rotation) * hinge);
  const glm::vec3 bent = glm::cross(old_first, old_second);
  const glm::vec3 old_hinge =
      bent * (glm::dot(bent, carried) < 0.0f ? -1.0f : 1.0f) + 0.05f * carried;
  const glm::vec3 flexed = glm::cross(bend, -direction);
  const glm::quat turn =
      glm::quat_cast(Basis(new_first, flexed) * glm::transpose(Basis(old_first, old_hinge)));
  TurnInActor(skeleton, upper, turn, pose);
  TurnInActor(skeleton, lower, Arc(turn * old_second, new_second), pose);
  return glm::distance(a + distance * direction, target);
}

void BringFoot(const Skeleton& skeleton,
               const BodyRig& body,
               int side,
               const JointFrame& ankle,
               std::span<JointTransform> pose) {
  const BodyRig::Leg& leg = body.legs[static_cast<size_t>(side)];
  const glm::vec3 forward(0.0f, 0.0f, -1.0f);
  const glm::quat turned =
      ankle.rotation * glm::conjugate(body.rest[static_cast<size_t>(leg.ankle)].rotation);
  const glm::vec3 points = turned * (TurnY(leg.toe_out) * forward);
  TwoBoneIk ik;
  ik.upper = leg.hip;
  ik.lower = leg.knee;
  ik.end = leg.ankle;
  ik.target = ankle.position;
  ik.pole = TurnY(kKneeTurn * std::atan2(-points.x, -points.z)) * forward;
  ik.hinge = glm::vec3(1.0f, 0.0f, 0.0f);
  ik.Solve(skeleton, body, pose);
  SetActorRotation(skeleton, leg.ankle, ankle.rotation, pose);
}

}  // namespace lararium::human
