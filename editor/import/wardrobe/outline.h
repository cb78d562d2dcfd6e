#pragma once

// The outline of the dressed body, or of a limb, for cloth around it: convex at every height.

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "editor/import/wardrobe/posed_body.h"

namespace lararium::import {

// Uses the angles of Girth about its own axis. Heights are above the floor.
class Outline {
 public:
  // Free of overhangs, about an axis through the waist. `worn` holds the garments on the body in
  // this pose. `left_arm` includes the left upper arm.
  Outline(const FittedBody& body,
          const PosedBody& posed,
          std::span<const Sheet* const> worn,
          bool left_arm);
  // The outline of the limb that begins at this joint (LimbOf), about its own middle.
  Outline(const FittedBody& body, const PosedBody& posed, std::string_view joint);

  float Radius(float angle, float height) const;
  // Radius for cloth that hangs from a height; it hardly comes nearer below its support.
  float Hanging(float angle, float from, float height) const;
  glm::vec3 Place(float angle, float radius, float height) const;

 private:
  static constexpr float kLevel = 0.02f;
  static constexpr int kAngles = 72;

  // A point counts at its level and this many below it.
  static void AddPoint(const glm::vec3& p,
                       size_t below,
                       std::vector<std::vector<glm::vec2>>& slabs);
  // The level below a height, and the share of the one above it.
  std::pair<size_t, float> LevelOf(float height) const;
  float AtLevel(size_t level, float angle) const;

  std::vector<glm::vec2> middle_;  // The axis at each level.
  std::vector<std::vector<float>> radius_;
};

}  // namespace lararium::import
