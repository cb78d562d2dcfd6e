#pragma once

// Dresses a person of the cast: cuts each garment of a recipe for the fitted body, drapes it
// (editor/import/wardrobe/drape.h) over the garments below, and converts it to the content of a
// .larhuman: drawn mesh, weave, simulated cloth.

#include <span>
#include <vector>

#include "editor/import/cast/cast_body.h"
#include "editor/import/wardrobe/fit.h"
#include "editor/import/wardrobe/garment_pattern.h"
#include "shared/core/progress.h"
#include "shared/core/status.h"

namespace lararium::import {

// `patterns` is in the order in which garments are put on; each is over the previous ones. A
// garment of several layers gives several results. Parts of inner garments that outer ones cover
// are left out. Deterministic. Takes about ten seconds per garment; cancelling gives an error, and
// so does a piece that does not fit (CheckFit).
Result<std::vector<Garment>> CutGarments(std::span<const GarmentPattern> patterns,
                                         const FittedBody& body,
                                         const Progress& progress);

// Drapes one garment over the bare body and measures how its pieces lie.
Result<std::vector<PieceFit>> TryOn(const GarmentPattern& pattern,
                                    const FittedBody& body,
                                    const Progress& progress);

}  // namespace lararium::import
