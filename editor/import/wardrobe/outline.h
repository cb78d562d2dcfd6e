#pragma once

// The outline of the dressed body for cloth around it: convex at every height, and free of
// overhangs.

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "editor/import/wardrobe/posed_body.h"

namespace lararium::import {

// Uses the angles of Girth about its own axis through the waist. Heights are above the floor.
class Outline {
 public:
  // `worn` holds the garments on the body in this pose. `left_arm` includes the left upper arm.
  Outline(const FittedBody& body,
          const PosedBody& posed,
          std::span<const Sheet* const> worn,
          bool left_arm);

  float Radius(float angle, float height) const;
  // Radius for cloth that hangs from a height; it hardly comes nearer below its support.
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
