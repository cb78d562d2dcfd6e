#pragma once

// Converts a draped garment to a drawn mesh and a simulated cloth.

#include <span>

#include "editor/import/cast/cast_body.h"
#include "editor/import/wardrobe/draped.h"
#include "editor/import/wardrobe/garment_pattern.h"
#include "shared/core/status.h"

namespace lararium::import {

// `whole` is the garment before covered parts were removed; it determines, together with what
// covers it, which skin is hidden.
Result<Garment> FinishGarment(const DrapedGarment& draped,
                              const DrapedGarment& whole,
                              const GarmentPattern& pattern,
                              const FittedBody& body);

// Removes the parts of an inner garment that outer ones cover.
void LeaveOutCovered(std::span<const DrapedGarment> outer,
                     const FittedBody& body,
                     DrapedGarment& inner);

}  // namespace lararium::import
