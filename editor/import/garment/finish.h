#pragma once

// From a draped garment to what is drawn and simulated.

#include <span>
#include <vector>

#include "editor/import/cast_body.h"
#include "editor/import/garment/draped.h"
#include "editor/import/garment/garment_pattern.h"
#include "shared/core/status.h"

namespace lararium::import {

// whole: the same before anything of it was left out, which hides skin together with
// what covers it.
Result<Garment> FinishGarment(const DrapedGarment& draped,
                              const DrapedGarment& whole,
                              const GarmentPattern& pattern,
                              const FittedBody& body);

// Leaves out of an inner garment what outer ones cover.
void LeaveOutCovered(std::span<const DrapedGarment> outer,
                     const FittedBody& body,
                     DrapedGarment& inner);

}  // namespace lararium::import
