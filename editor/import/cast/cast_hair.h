#pragma once

// Fits hair to a head for which it was not modelled.

#include "editor/import/cast/cast_paint.h"
#include "editor/import/cast/cast_parts.h"

namespace lararium::import {

// `volume` is the height of the hair above the scalp relative to the model. `tilt` rotates it
// about the ears into the face, in radians.
struct HairFit {
  float volume = 1.0f;
  float tilt = 0.0f;
  float clearance = 0.003f;  // Least distance above the skin, metres.
};

// Lifts hair that would intersect the skull, applies the volume, and shades it as one rounded
// shape instead of separate cards.
void LayHair(CastPiece& hair, const FittedBody& body, const HairFit& fit);

// Coverage (0..1) of the skin at `place` by hair that is close and in the direction of the
// normal.
float CoverOver(const glm::vec3& place,
                const glm::vec3& normal,
                const human::SkinnedMesh& hair,
                const Coverage& picture);

}  // namespace lararium::import
