#pragma once

// Dresses a person of the cast: cuts each garment of a recipe over the fitted body,
// drapes it (editor/import/garment/drape.h) over what is worn below, and makes of it
// what a .larhuman holds: drawn mesh, weave, simulated cloth.

#include <span>
#include <vector>

#include "editor/import/cast_body.h"
#include "editor/import/garment/garment_pattern.h"
#include "shared/core/progress.h"
#include "shared/core/status.h"

namespace lararium::import {

// In the order in which they are put on; each lies over those before. What an outer one
// covers of an inner one is left out. The same patterns and body give the same garments.
// A person needs about ten seconds for each; where they are cancelled, that is an error.
Result<std::vector<Garment>> CutGarments(std::span<const GarmentPattern> patterns,
                                         const FittedBody& body,
                                         const Progress& progress);

}  // namespace lararium::import
