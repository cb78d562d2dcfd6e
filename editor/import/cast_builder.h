#pragma once

// Builds people of the cast: a recipe and the library make a human with skeleton,
// skin, eyes, teeth, hair, face shapes, levels of detail and credits.

#include <filesystem>

#include "editor/import/cast_body.h"
#include "editor/import/cast_library.h"
#include "editor/import/cast_recipe.h"
#include "shared/core/progress.h"
#include "shared/core/status.h"
#include "shared/human/human.h"

namespace lararium::import {

// The bare body in the recipe's shape: what garments are cut on.
Result<FittedBody> FitBody(const CastLibrary& library, const CastRecipe& recipe);

// The same library and recipe give the same human. Errors name the recipe's field or
// the library's file. Seconds; where they are cancelled, that is an error too.
Result<human::Human> BuildCast(const CastLibrary& library,
                               const CastRecipe& recipe,
                               const Progress& progress);

}  // namespace lararium::import
