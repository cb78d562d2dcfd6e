#pragma once

// Belts and cords over a garment.

#include "editor/import/cast/cast_body.h"
#include "editor/import/wardrobe/draped.h"
#include "editor/import/wardrobe/garment_pattern.h"
#include "editor/import/wardrobe/measures.h"
#include "editor/import/wardrobe/posed_body.h"

namespace lararium::import {

// A girdle on one body. Lengths are metres.
struct Girdle {
  bool tied = false;
  float height = 1.0f;  // Height of the middle on the standing person.
  float lift = 0.0f;    // Cloth pulled up over it.
  float half = 0.017f;  // Half of its width.
  bool round = false;   // A cord.
  glm::vec3 colour = glm::vec3(0.1f);
};

// The girdle of a garment. Where it has none, the height is that of the waist.
Girdle MeasureGirdle(const GarmentPattern& pattern, const Measures& measures);

// A belt or cord around the outside of the garments, with a knot and two ends in front.
Trim TieGirdle(const Girdle& girdle,
               const FittedBody& body,
               const PosedBody& standing,
               const Sheet& worn);

}  // namespace lararium::import
