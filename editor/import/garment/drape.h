#pragma once

// Lets a sheet of cloth fall into place over a body that holds still: position-based
// dynamics (Mueller, Heidelberger, Hennix & Ratcliff, "Position Based Dynamics", JVCIR
// 2007) with strong damping, until it rests. For cutting garments, not for the show.

#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <vector>

#include "editor/import/garment/body_field.h"
#include "editor/import/garment/sheet.h"
#include "shared/core/progress.h"

namespace lararium::import {

struct DrapeMaterial {
  float stretch = 1.0f;    // share of an edge's error mended at a time
  float shear = 0.25f;     // the same for edges across the threads
  float squeeze = 0.9f;    // the same for edges that are too short: what makes folds
  float bend = 0.04f;      // the same between corners on both sides of an edge
  float friction = 0.5f;   // on the body
  float gap = 0.008f;      // metres kept from the body
  float own_gap = 0.010f;  // metres kept between two places of the cloth; 0: may cross
};

// A particle drawn to a place.
struct DrapePin {
  uint32_t particle = 0;
  glm::vec3 place = glm::vec3(0.0f);
  float strength = 1.0f;  // share of the way at a time
};

class Draper {
 public:
  // Lengths at rest are those on the panels. Where progress is cancelled, nothing moves any more.
  Draper(Sheet& sheet, const DrapeMaterial& material, const Progress& progress);

  // What a place on the cloth may be from another: cloth cannot be longer than it is.
  void Tether(uint32_t particle, uint32_t anchor, float length);
  // Gathered cloth: edges whose ends are both of these resist no squeezing.
  void Gather(const std::vector<bool>& particles);
  // Lengths as they are now, times a factor: for cloth that is laid in folds before it
  // is let go.
  void TakeLengths(float factor);

  std::vector<DrapePin> pins;
  // Called in each iteration: what else the positions must obey.
  std::function<void(std::vector<glm::vec3>&)> rule;
  bool floor = false;     // at y = 0
  float gravity = 3.0f;   // m/s^2: the folds hardly depend on it, the stretch does
  float damping = 0.06f;  // of the speed, each step

  void Run(int steps, const BodyField& body);
  // Forgets all motion.
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
