#pragma once

// The body that a garment is cut for, in a pose of its own; and its measures.

#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "editor/import/cast_body.h"
#include "editor/import/garment/body_field.h"
#include "editor/import/garment/sheet.h"

namespace lararium::import {

using JointTurn = std::pair<std::string_view, glm::quat>;  // from the bind pose

struct PosedBody {
  std::vector<glm::mat4> skin;       // [joint], as human::ComputeSkinMatrices gives it
  std::vector<glm::vec3> positions;  // of every base vertex
  std::vector<glm::vec3> normals;    // of the body's; others zero
  std::vector<Triangle> triangles;   // of the body's surface
  std::vector<bool> forearm;         // of every base vertex
};

PosedBody PoseBody(const FittedBody& body, std::span<const JointTurn> turns);

glm::vec3 JointPlace(const FittedBody& body, const PosedBody& posed, std::string_view joint);
// Must exist in the skeleton.
size_t JointNumber(const FittedBody& body, std::string_view joint);

// Both upper arms this far from hanging straight down, elbows a little bent;
// 0: as in the bind pose, 1: all the way.
std::vector<JointTurn> ArmsLowered(const FittedBody& body, float angle, float share);

// Without forearms and hands, cloth cannot be caught on the wrong side of them.
BodyField FieldOf(const PosedBody& posed, float cell, float band, bool forearms = true);

// The same over what is worn already.
BodyField FieldOver(const PosedBody& posed,
                    std::span<const Sheet* const> worn,
                    float cell,
                    float band);

// Distances of a convex hull from a middle axis, at count angles (as Girth's).
std::vector<float> HullRadius(std::span<const glm::vec2> points, glm::vec2 middle, int count);

// How far to each side cloth may hang so that forearms and hands stay free of it.
class ArmWalls {
 public:
  explicit ArmWalls(const PosedBody& posed);
  // Brings a place inside.
  void Keep(glm::vec3& place) const;

 private:
  static constexpr float kBin = 0.03f;
  std::vector<float> side_;  // by height
};

// Linear blend of matrices as weights say.
glm::mat4 Blend(std::span<const glm::mat4> skin, std::span<const float> weights);

// A closed curve round the body at one height, as distances from a middle axis.
class Girth {
 public:
  static constexpr int kAngles = 72;

  // The convex hull of the points of the trunk and legs (or of any part whose share of
  // arms and head is small) within half a slab of the height, and of more points.
  Girth(const FittedBody& body, const PosedBody& posed, float height, float half_slab);

  // angle: 0 to the person's back (+z), a quarter turn to their right (+x).
  float Radius(float angle) const;
  glm::vec3 Place(float angle, float beyond, float height) const;
  float AngleOf(const glm::vec3& place) const;
  glm::vec3 middle() const { return middle_; }
  float Length() const;
  // Where this share of the length is passed, from the back to the person's right.
  float AngleAt(float share) const;
  void Include(std::span<const glm::vec3> points);

 private:
  void Rebuild();
  std::vector<glm::vec2> points_;
  glm::vec3 middle_ = glm::vec3(0.0f);
  std::vector<float> radius_;
};

// How much of a base vertex moves with an arm or with head and neck, 0..1.
std::vector<float> ArmShare(const FittedBody& body);
std::vector<float> HeadShare(const FittedBody& body);
// Of each joint: whether it is a shoulder or below one.
std::vector<bool> ArmJoints(const FittedBody& body);
// Of those helpers that are no body: false.
std::vector<bool> IsBody(const FittedBody& body);

}  // namespace lararium::import
