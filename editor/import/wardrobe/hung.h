#pragma once

// Drapes garments of which one piece hangs before and one behind the body. They are sewn together
// along the shoulders and the sides; arms and head pass through the openings, and the width of the
// cloth forms the sleeves. A girdle gathers it, and some of its length is pulled up over the girdle
// (Croom, "Roman Clothing and Fashion", 2000, chapters 2 and 4).

#include <span>

#include "editor/import/cast/cast_body.h"
#include "editor/import/wardrobe/draped.h"
#include "editor/import/wardrobe/garment_pattern.h"
#include "shared/core/progress.h"
#include "shared/core/status.h"

namespace lararium::import {

// `pieces` are the one in front and the one behind. `worn` holds the garments below it.
Result<DrapedGarment> DrapeHung(const GarmentPattern& pattern,
                                std::span<const Piece> pieces,
                                const FittedBody& body,
                                std::span<const DrapedGarment> worn,
                                const Progress& progress);

}  // namespace lararium::import
