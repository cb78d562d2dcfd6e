#pragma once

// A garment between its draping and the mesh that is drawn.

#include <cstdint>
#include <functional>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "editor/import/cast_body.h"
#include "editor/import/garment/body_field.h"
#include "editor/import/garment/garment_pattern.h"
#include "editor/import/garment/posed_body.h"
#include "editor/import/garment/sheet.h"

namespace lararium::import {

// How people stand when nothing moves them: what garments are draped on. Arms hang,
// legs stand below the hips.
std::vector<JointTurn> StandingTurns(const FittedBody& body, float share);

// A plain part that is worn with the cloth: belt, cord, knot.
struct Trim {
  Sheet sheet;  // with weights
  glm::vec3 colour = glm::vec3(0.5f);
};

struct DrapedGarment {
  std::vector<glm::mat4> skin;  // of the pose it was draped in
  Sheet sheet;                  // with weights
  // What is simulated: sheet's first particles, at places of their own, and triangles of
  // them; which of these each triangle of sheet follows.
  std::vector<glm::vec3> coarse_positions;
  std::vector<Triangle> coarse_triangles;
  std::vector<uint32_t> coarse_of;
  std::vector<float> reach;  // of each particle; 0: plain skin
  std::function<glm::vec3(uint8_t panel, const glm::vec2& flat)> dye;  // linear RGB
  std::vector<Trim> trims;
  // What lies further left and higher is covered for certain: the arm in a mantle.
  float covers_left_of = -1e9f;
  float covers_above = 1e9f;
  // What lies lower and does not move with an arm is covered for certain: a tunic's sides.
  float covers_trunk_below = -1e9f;
  bool covers = true;          // hides what lies below it
  bool wraps = false;          // covers so much that what it hides need not be simulated
  float cover_margin = 0.05f;  // from its edges, within which garments below it stay
  float hide_margin = 0.03f;   // metres from the cloth's edges within which skin stays
  float loose_margin = 0.16f;  // the same from hems of loose parts, seen from below
};

// Takes the sheet as it is for what is simulated, and divides it so often for drawing.
void Divide(int times, Sheet& sheet, DrapedGarment& garment);

}  // namespace lararium::import
