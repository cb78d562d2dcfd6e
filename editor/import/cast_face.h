#pragma once

// What the face of a person of the cast can do: the library's expression units as
// morph targets over skin, lashes, brows, teeth, tongue and beard, and the visemes,
// expressions and blinks composed of them.

#include <span>
#include <vector>

#include "editor/import/cast_library.h"
#include "editor/import/cast_parts.h"
#include "editor/import/cast_recipe.h"
#include "shared/human/human.h"

namespace lararium::import {

// Fills human.morphs and human.face. pieces: parallel to the human's meshes.
void AddFace(const CastLibrary& library,
             const CastRecipe& recipe,
             const BaseShape& shape,
             std::span<const CastPiece> pieces,
             human::Human& human);

}  // namespace lararium::import
