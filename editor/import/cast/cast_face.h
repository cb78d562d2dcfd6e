#pragma once

// The face of a person of the cast: the expression units of the library as morph targets for
// skin, lashes, brows, teeth, tongue and beard, and the visemes, expressions and blinks
// composed of them.

#include <span>

#include "editor/import/cast/cast_library.h"
#include "editor/import/cast/cast_parts.h"
#include "editor/import/cast/cast_recipe.h"
#include "shared/human/human.h"

namespace lararium::import {

// Fills `human.morphs` and `human.face`. `pieces` is parallel to the meshes of the human.
void AddFace(const CastLibrary& library,
             const CastRecipe& recipe,
             const BaseShape& shape,
             std::span<const CastPiece> pieces,
             human::Human& human);

}  // namespace lararium::import
