#pragma once

// Sandals: a leather sole under each foot and straps shaped from its surface.

#include "editor/import/cast_body.h"
#include "editor/import/garment/draped.h"
#include "editor/import/garment/garment_pattern.h"
#include "shared/core/status.h"

namespace lararium::import {

Result<DrapedGarment> CutSandals(const GarmentPattern& pattern, const FittedBody& body);

}  // namespace lararium::import
