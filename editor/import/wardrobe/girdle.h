#pragma once

// Belts and cords over a garment.

#include "editor/import/cast/cast_body.h"
#include "editor/import/wardrobe/draped.h"
#include "editor/import/wardrobe/garment_pattern.h"
#include "editor/import/wardrobe/posed_body.h"

namespace lararium::import {

// Height of the middle of the belt on the standing person, metres.
float BeltHeight(const GarmentPattern& pattern, const FittedBody& body);

// A belt or cord around the outside of the garments, with a knot and two ends in front.
Trim TieGirdle(const GarmentPattern& pattern,
               const FittedBody& body,
               const PosedBody& standing,
               const Sheet& worn,
               float height);

}  // namespace lararium::import
