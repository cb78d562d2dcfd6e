#pragma once

// Mantles, which are wrapped around the body and over the left shoulder.
//
// Toga and palla begin at the left shoulder in front, cross the back, pass under the right arm
// and return across the chest over the left shoulder, where the rest hangs down behind. The
// upper part of the toga is folded over and hangs in a bow to the right knee (sinus); its edge
// is rolled into a band from the right hip to the left shoulder (balteus). After Wilson, "The
// Roman Toga", 1924, and Goette, "Studien zu roemischen Togadarstellungen", 1990, form B.

#include <span>

#include "editor/import/cast/cast_body.h"
#include "editor/import/wardrobe/draped.h"
#include "editor/import/wardrobe/garment_pattern.h"
#include "shared/core/progress.h"
#include "shared/core/status.h"

namespace lararium::import {

Result<DrapedGarment> DrapeMantle(const GarmentPattern& pattern,
                                  const Piece& piece,
                                  const FittedBody& body,
                                  std::span<const DrapedGarment> worn,
                                  const Progress& progress);

}  // namespace lararium::import
