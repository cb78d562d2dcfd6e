#pragma once

// Belts and cords over a garment.

#include "editor/import/cast_body.h"
#include "editor/import/garment/draped.h"
#include "editor/import/garment/garment_pattern.h"
#include "editor/import/garment/posed_body.h"

namespace lararium::import {

// Height of the belt's middle as the person stands, metres.
float BeltHeight(const GarmentPattern& pattern, const FittedBody& body);

// A belt or cord on the outside of what is worn, with a knot and two ends in front.
Trim TieGirdle(const GarmentPattern& pattern,
               const FittedBody& body,
               const PosedBody& standing,
               const Sheet& worn,
               float height);

}  // namespace lararium::import
