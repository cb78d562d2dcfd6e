#pragma once

// The shape of a person of the cast: the base mesh moved by weighted morph targets. Age, sex,
// muscle, weight, height, proportions and ethnicity act together: a target is named after its
// properties ("female-old-minmuscle-maxweight"), and its weight is the product of the person's
// values for each of them (the published scheme of MakeHuman).

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "editor/import/cast/cast_library.h"
#include "editor/import/cast/cast_recipe.h"
#include "shared/core/status.h"

namespace lararium::import {

struct TargetShare {
  size_t target = 0;
  float share = 0.0f;
};

// The targets that shape this person apart from the requested height, and their weights. Fails
// if the library lacks a slider of the recipe.
Result<std::vector<TargetShare>> TargetShares(const CastLibrary& library, const CastRecipe& recipe);

// The targets of one expression unit ("mouth-open"), mixed by ethnicity.
std::vector<TargetShare> UnitShares(const CastLibrary& library,
                                    const CastRecipe& recipe,
                                    std::string_view unit);

// The sum of weighted targets at every base vertex: metres, actor frame (Y up, facing -Z).
std::vector<glm::vec3> TargetDeltas(const CastLibrary& library,
                                    std::span<const TargetShare> shares);

// Every base vertex of the person: metres, actor frame, soles at y = 0.
Result<std::vector<glm::vec3>> ShapeBase(const CastLibrary& library, const CastRecipe& recipe);

// The stored base mesh in metres and the actor frame.
std::vector<glm::vec3> UnshapedBase(const CastLibrary& library);

}  // namespace lararium::import
