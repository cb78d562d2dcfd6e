#pragma once

// Measures how the pieces of a draped garment lie on the body, and refuses cloth that has come
// apart, is too tight, or is in the body.

#include <span>
#include <string>
#include <vector>

#include "editor/import/cast/cast_body.h"
#include "editor/import/wardrobe/body_field.h"
#include "editor/import/wardrobe/draped.h"
#include "editor/import/wardrobe/garment_design.h"
#include "editor/import/wardrobe/posed_body.h"
#include "shared/core/status.h"

namespace lararium::import {

// The fit of a piece. Stretch is the length of a thread between two points over the length that was
// cut.
struct PieceFit {
  std::string piece;
  float stretch = 1.0f;       // Median.
  float stretch_99 = 1.0f;    // 99th percentile.
  float stretch_most = 1.0f;  // The largest stretch.
  std::string stretched_at;   // Part of the body, and seam: "left upper arm, seam \"left side\"".
  float inside = 0.0f;        // Share of the points that are more than 1 cm deep in the body.
  std::string inside_at;      // Part of the body at the deepest point.
  float area = 1.0f;          // Area over the area that was cut.
  size_t lost = 0;            // Points that are not finite or further than 0.6 m from the body.
};

// The standing body, against which garments are measured.
struct StandingField {
  explicit StandingField(const FittedBody& body);
  explicit StandingField(const PosedBody& standing);

  BodyField field;
  glm::vec3 low;
  glm::vec3 high;
};

// `pieces` are those of the panels of the draped cloth; the last one also has all further panels.
// The result is in their order, without those that are not draped, such as sandals.
std::vector<PieceFit> MeasureFit(const DrapedGarment& draped,
                                 std::span<const Piece> pieces,
                                 std::span<const Seam> seams,
                                 const FittedBody& body,
                                 const StandingField& standing);

// The first fault, with the garment's file, the piece, the place and what to do.
Status CheckFit(std::span<const PieceFit> fits, const GarmentDesign& design);

}  // namespace lararium::import
