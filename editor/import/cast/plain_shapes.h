#pragma once

// The solids of the plain figure as signed distances (implicit_surface.h). Points are in the
// actor frame, metres, in the rest pose of PlainSkeleton().

#include <glm/common.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "editor/import/cast/implicit_surface.h"
#include "shared/human/skeleton.h"

namespace lararium::import {

inline constexpr glm::vec3 kPlainEye(0.0315f, 1.611f, -0.0665f);  // Right eye.
inline constexpr float kPlainHem = 0.490f;                        // Metres above the floor.

// Mirrors points of the left side to the right side.
inline glm::vec3 FoldX(const glm::vec3& p) { return {glm::abs(p.x), p.y, p.z}; }

float PlainHead(const glm::vec3& p);  // Includes the neck.
float PlainHair(const glm::vec3& p);

// The right arm with its hand.
class PlainArm {
 public:
  explicit PlainArm(const human::Skeleton& skeleton);

  const glm::vec3& shoulder() const { return shoulder_; }
  // Unit vector from shoulder to elbow.
  glm::vec3 direction() const;
  // Coordinates in the frame of the hand: out of its back, along the fingers, towards the
  // thumb.
  glm::vec3 InHand(const glm::vec3& p) const;

  float Distance(const glm::vec3& p) const;
  // Positive on the side of the hand beyond the wrist.
  float BeyondWrist(const glm::vec3& p) const { return InHand(p).y; }

 private:
  glm::vec3 HandPoint(float back, float along, float thumb) const;
  float Hand(const glm::vec3& p) const;
  float Thumb(const glm::vec3& p) const;
  float Fingers(const glm::vec3& p) const;

  glm::vec3 shoulder_, elbow_, wrist_;
  glm::mat3 hand_axes_;
  Loft upper_, fore_, palm_;
};

// The right leg with foot and sandal.
class PlainLeg {
 public:
  PlainLeg();

  float Distance(const glm::vec3& p) const;
  float Sandal(const glm::vec3& p) const;

 private:
  float Foot(const glm::vec3& p) const;

  Loft limb_, foot_, footprint_;
};

// Tunic and belt.
class PlainTunic {
 public:
  // Keeps a reference to the arm.
  explicit PlainTunic(const PlainArm& arm);

  float Distance(const glm::vec3& p) const;
  float Belt(const glm::vec3& p) const;

 private:
  float Cloth(const glm::vec3& p) const;
  float Trunk(const glm::vec3& p) const;
  glm::vec3 SleeveAxis(float t) const;
  float Along(const glm::vec3& q) const;
  float SleeveTube(const glm::vec3& q) const;
  float Sleeve(const glm::vec3& p) const;
  float HollowSleeve(const glm::vec3& p) const;
  float HollowBelow(const glm::vec3& p) const;
  float Neckline(const glm::vec3& p) const;

  const PlainArm& arm_;
  Loft trunk_;
};

}  // namespace lararium::import
