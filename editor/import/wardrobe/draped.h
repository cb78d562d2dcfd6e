#pragma once

// A garment after draping and before it becomes a drawn mesh.

#include <cstdint>
#include <functional>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "editor/import/cast/cast_body.h"
#include "editor/import/wardrobe/posed_body.h"
#include "editor/import/wardrobe/sheet.h"

namespace lararium::import {

// The rotations from the bind pose to standing, with hanging arms and legs below the hips;
// garments are draped in this pose.
std::vector<JointTurn> StandingTurns(const FittedBody& body, float share);

// A rigid part that is worn with the cloth: belt, cord, knot.
struct Trim {
  Sheet sheet;  // Includes weights.
  glm::vec3 colour = glm::vec3(0.5f);
};

struct DrapedGarment {
  std::vector<glm::mat4> skin;  // Skin matrices of the pose in which it was draped.
  Sheet sheet;                  // Includes weights.
  // The simulated cloth: the first particles of `sheet` at their own positions, triangles
  // between them, and for each triangle of `sheet` the coarse triangle that it follows.
  std::vector<glm::vec3> coarse_positions;
  std::vector<Triangle> coarse_triangles;
  std::vector<uint32_t> coarse_of;
  std::vector<float> reach;  // Reach of the simulation for each particle; 0 means skinned only.
  std::function<glm::vec3(uint8_t panel, const glm::vec2& flat)> dye;  // linear RGB
  std::vector<Trim> trims;
  // Everything further left and higher is covered for certain: the arm in a mantle.
  float covers_left_of = -1e9f;
  float covers_above = 1e9f;
  // Everything lower that does not move with an arm is covered for certain: the sides of a
  // tunic.
  float covers_trunk_below = -1e9f;
  bool covers = true;          // Hides what is below it.
  bool wraps = false;          // Hidden cloth need not be simulated.
  float cover_margin = 0.05f;  // Metres from its edges within which garments below it stay.
  float hide_margin = 0.03f;   // Metres from the edges of the cloth within which skin stays.
  float loose_margin = 0.16f;  // The same at hems of loose parts, which are visible from below.
};

// Stores the sheet as the simulated cloth and subdivides it `times` times for drawing.
void Divide(int times, Sheet& sheet, DrapedGarment& garment);

// The sheets of garments, which must outlive the result.
std::vector<const Sheet*> SheetsOf(std::span<const DrapedGarment> worn);

}  // namespace lararium::import
