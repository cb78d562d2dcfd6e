#pragma once

// The dressed body as cloth lies round it: convex at every height, and hanging.

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "editor/import/garment/posed_body.h"

namespace lararium::import {

// Angles as Girth's, about an axis of its own through the waist; heights above the floor.
class Outline {
 public:
  // worn: what lies on the body in this pose. left_arm: the upper one is wrapped in.
  Outline(const FittedBody& body,
          const PosedBody& posed,
          std::span<const Sheet* const> worn,
          bool left_arm);

  float Radius(float angle, float height) const;
  // Of cloth that hangs from a height: it leans in but little below what it lies on.
  float Hanging(float angle, float from, float height) const;
  glm::vec3 Place(float angle, float radius, float height) const;
  float AngleOf(const glm::vec3& place) const;

 private:
  static constexpr float kLevel = 0.02f;
  static constexpr int kAngles = 72;

  float AtLevel(size_t level, float angle) const;

  glm::vec2 middle_ = glm::vec2(0.0f);
  std::vector<std::vector<float>> radius_;
};

}  // namespace lararium::import
