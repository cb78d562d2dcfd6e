#pragma once

// Builds people of the cast: makes a human with skeleton, skin, eyes, teeth, hair, face shapes,
// levels of detail and credits from a recipe and the library.

#include "editor/import/cast/cast_body.h"
#include "editor/import/cast/cast_library.h"
#include "editor/import/cast/cast_recipe.h"
#include "shared/core/progress.h"
#include "shared/core/status.h"
#include "shared/human/human.h"

namespace lararium::import {

// The bare body in the shape of the recipe, on which garments are cut.
Result<FittedBody> FitBody(const CastLibrary& library, const CastRecipe& recipe);

// Deterministic. Errors name the field of the recipe or the file of the library. Takes seconds;
// cancelling gives an error.
Result<human::Human> BuildCast(const CastLibrary& library,
                               const CastRecipe& recipe,
                               const Progress& progress);

}  // namespace lararium::import
