#pragma once

// The tunic and what is cut like it. Two rectangles are sewn together along the
// shoulders and the sides; arms and head go through what is left open, and the width of
// the cloth makes the sleeves. A belt gathers it, and some of its length is drawn up
// over the belt (Croom, "Roman Clothing and Fashion", 2000, chapters 2 and 4).

#include <span>

#include "editor/import/cast_body.h"
#include "editor/import/garment/draped.h"
#include "editor/import/garment/garment_pattern.h"
#include "shared/core/progress.h"
#include "shared/core/status.h"

namespace lararium::import {

// worn: what lies below it.
Result<DrapedGarment> DrapeTunic(const GarmentPattern& pattern,
                                 const FittedBody& body,
                                 std::span<const DrapedGarment> worn,
                                 const Progress& progress);

}  // namespace lararium::import
