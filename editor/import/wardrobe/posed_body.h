#pragma once

// The body for which a garment is cut, in a pose of its own, and its measurements.

#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "editor/import/cast/cast_body.h"
#include "editor/import/wardrobe/body_field.h"
#include "editor/import/wardrobe/sheet.h"

namespace lararium::import {

// Joint name and rotation from the bind pose.
using JointTurn = std::pair<std::string_view, glm::quat>;

struct PosedBody {
  std::vector<glm::mat4> skin;       // [joint], as computed by human::ComputeSkinMatrices.
  std::vector<glm::vec3> positions;  // All base vertices.
  std::vector<glm::vec3> normals;    // Normals of the body's base vertices; zero for others.
  std::vector<Triangle> triangles;   // Surface of the body.
  std::vector<bool> forearm;  // Says for each base vertex whether it is on a forearm or hand.
};

PosedBody PoseBody(const FittedBody& body, std::span<const JointTurn> turns);

glm::vec3 JointPlace(const FittedBody& body, const PosedBody& posed, std::string_view joint);
// The joint must exist in the skeleton.
size_t JointNumber(const FittedBody& body, std::string_view joint);

// Rotations that bring both upper arms to this angle from hanging straight down, with slightly
// bent elbows. A share of 0 gives the bind pose, 1 the full rotation.
std::vector<JointTurn> ArmsLowered(const FittedBody& body, float angle, float share);

// The field of the body together with the garments already worn. Without forearms and hands, cloth
// cannot be caught on the wrong side of them.
BodyField FieldOf(const PosedBody& posed,
                  float cell,
                  float band,
                  bool forearms = true,
                  std::span<const Sheet* const> worn = {});

// Distances of a convex hull from a middle axis, at `count` angles (those of Girth).
std::vector<float> HullRadius(std::span<const glm::vec2> points, glm::vec2 middle, int count);

// Limits how far cloth may hang to each side, so that it stays clear of forearms and hands.
class ArmWalls {
 public:
  explicit ArmWalls(const PosedBody& posed);
  // Moves a position inside the limits.
  void Keep(glm::vec3& place) const;

 private:
  static constexpr float kBin = 0.03f;
  std::vector<float> side_;  // Indexed by height.
};

// Blends matrices linearly by weights.
glm::mat4 Blend(std::span<const glm::mat4> skin, std::span<const float> weights);

// A closed curve around the body at one height, as distances from a middle axis.
class Girth {
 public:
  static constexpr int kAngles = 72;

  // The convex hull of the points of trunk and legs (vertices whose share of arms and head is
  // small) within `half_slab` of the height.
  Girth(const FittedBody& body, const PosedBody& posed, float height, float half_slab);

  // An angle of 0 points to the back of the person (+z), a quarter turn to their right (+x).
  float Radius(float angle) const;
  glm::vec3 Place(float angle, float beyond, float height) const;
  float AngleOf(const glm::vec3& place) const;
  glm::vec3 middle() const { return middle_; }
  float Length() const;
  // The angle at which this share of the length is reached, from the back to the right.
  float AngleAt(float share) const;

 private:
  glm::vec3 middle_ = glm::vec3(0.0f);
  std::vector<float> radius_;
};

// The share 0..1 of each base vertex that moves with an arm, or with head and neck.
std::vector<float> ArmShare(const FittedBody& body);
std::vector<float> HeadShare(const FittedBody& body);
// Says for each base vertex whether it is a part of the body that moves most with this joint and
// those below it, such as "l_hip" for the left leg.
std::vector<bool> LimbOf(const FittedBody& body, std::string_view joint);
// Says for each joint whether it is a shoulder or below one.
std::vector<bool> ArmJoints(const FittedBody& body);
// Says for each base vertex whether it belongs to the body; helpers do not.
std::vector<bool> IsBody(const FittedBody& body);

}  // namespace lararium::import
