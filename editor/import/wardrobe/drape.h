#pragma once

// Drapes a sheet of cloth over a static body: position-based dynamics (Mueller, Heidelberger,
// Hennix & Ratcliff, "Position Based Dynamics", JVCIR 2007) with strong damping until the cloth
// rests. Used for cutting garments, not in the show.

#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "editor/import/wardrobe/body_field.h"
#include "editor/import/wardrobe/sheet.h"
#include "shared/core/progress.h"

namespace lararium::import {

struct DrapeMaterial {
  float stretch = 1.0f;    // Share of an edge's error that an iteration corrects.
  float shear = 0.25f;     // The same for edges across the threads.
  float squeeze = 0.9f;    // The same for edges that are too short; it makes folds.
  float bend = 0.04f;      // The same between corners on both sides of an edge.
  float friction = 0.5f;   // Friction on the body.
  float gap = 0.008f;      // Least distance from the body, metres.
  float own_gap = 0.010f;  // Least distance between parts of the cloth, metres; 0 lets them cross.
};

// Pulls a particle to a position.
struct DrapePin {
  uint32_t particle = 0;
  glm::vec3 place = glm::vec3(0.0f);
  float strength = 1.0f;  // Share of the distance per iteration.
};

// Says whether a line on a panel crosses the threads diagonally, where cloth shears.
bool IsAcrossThreads(const glm::vec2& line);

class Draper {
 public:
  // Rest lengths are those on the panels. After cancelling, nothing moves.
  Draper(Sheet& sheet, const DrapeMaterial& material, const Progress& progress);

  // Limits the distance of a particle from an anchor, because cloth does not stretch beyond its
  // length.
  void Tether(uint32_t particle, uint32_t anchor, float length);
  // Gathers cloth: edges between two of these particles do not resist compression.
  void Gather(const std::vector<bool>& particles);
  // Sets rest lengths to the current lengths times a factor, for cloth that is folded before it
  // is released.
  void TakeLengths(float factor);

  std::vector<DrapePin> pins;
  // Runs in each iteration and applies further constraints to the positions.
  std::function<void(std::vector<glm::vec3>&)> rule;
  bool floor = false;     // Keeps the cloth above y = 0.
  float gravity = 3.0f;   // m/s^2; folds hardly depend on it, stretch does.
  float damping = 0.06f;  // Share of the velocity lost in each step.

  void Run(int steps, const BodyField& body);
  // Sets all velocities to zero.
  void Rest();

 private:
  struct Edge {
    uint32_t a = 0;
    uint32_t b = 0;
    float length = 0.0f;
    float stretch = 1.0f;
    float squeeze = 1.0f;
  };
  struct TetherLine {
    uint32_t particle = 0;
    uint32_t anchor = 0;
    float length = 0.0f;
  };

  void Step(const BodyField& body);
  void MendEdges(bool backward);
  void KeepOut(const BodyField& body);
  void FindPairs();
  void KeepApart();

  Sheet& sheet_;
  DrapeMaterial material_;
  const Progress& progress_;
  std::vector<Edge> edges_;
  std::vector<Edge> bends_;
  std::vector<TetherLine> tethers_;
  std::vector<std::vector<uint32_t>> neighbours_;
  std::vector<std::array<uint32_t, 2>> pairs_;
  std::vector<glm::vec3> before_;
  std::vector<glm::vec3> velocity_;
  int steps_ = 0;
};

}  // namespace lararium::import
