#pragma once

// Hair that lies on the head that it was not made for.

#include "editor/import/cast_paint.h"
#include "editor/import/cast_parts.h"

namespace lararium::import {

// How hair is laid on a head. volume: its height above the scalp, of what it was
// modelled with. tilt: radians about the ears, into the face.
struct HairFit {
  float volume = 1.0f;
  float tilt = 0.0f;
  float clearance = 0.003f;  // metres above the skin, at least
};

// Lifts what the skull would cut through, gives the hair its volume, and shades it as the
// rounded whole that it is, not as the cards that it is made of.
void LayHair(CastPiece& hair, const FittedBody& body, const HairFit& fit);

// How much of the hair (0..1, its picture's coverage) lies over a place of the skin: straight
// out from it, and close.
float CoverOver(const glm::vec3& place,
                const glm::vec3& normal,
                const human::SkinnedMesh& hair,
                const Coverage& picture);

}  // namespace lararium::import
