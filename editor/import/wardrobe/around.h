#pragma once

// Drapes cloth that is gathered around the body at one height, and whose folds hang down from
// there (aprons and skirts), and tubes about both legs or arms (hose, stockings, sleeves).

#include <span>

#include "editor/import/cast/cast_body.h"
#include "editor/import/wardrobe/draped.h"
#include "editor/import/wardrobe/garment_pattern.h"
#include "shared/core/progress.h"
#include "shared/core/status.h"

namespace lararium::import {

// `worn` holds the garments below it.
Result<DrapedGarment> DrapeAround(const GarmentPattern& pattern,
                                  const Piece& piece,
                                  const FittedBody& body,
                                  std::span<const DrapedGarment> worn,
                                  const Progress& progress);

}  // namespace lararium::import
