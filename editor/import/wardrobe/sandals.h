#pragma once

// Cuts sandals: a leather sole under each foot, and straps shaped from its surface.

#include "editor/import/cast/cast_body.h"
#include "editor/import/wardrobe/draped.h"
#include "editor/import/wardrobe/garment_pattern.h"
#include "shared/core/status.h"

namespace lararium::import {

Result<DrapedGarment> CutSandals(const GarmentPattern& pattern, const FittedBody& body);

}  // namespace lararium::import
