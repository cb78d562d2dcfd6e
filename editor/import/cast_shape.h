#pragma once

// The shape of a person of the cast: the base mesh moved by weighted morph targets.
// Age, sex, muscle, weight, height, proportions and ethnicity act together: a target
// is named after what it stands for ("female-old-minmuscle-maxweight") and its share
// is the product of how much of each the person has (MakeHuman's published scheme).

#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <vector>

#include "editor/import/cast_library.h"
#include "editor/import/cast_recipe.h"
#include "shared/core/status.h"

namespace lararium::import {

struct TargetShare {
  size_t target = 0;
  float share = 0.0f;
};

// The targets that shape this person but for the wanted height, and how much of each.
// Fails on sliders that the library has not.
Result<std::vector<TargetShare>> TargetShares(const CastLibrary& library, const CastRecipe& recipe);

// The targets of one expression unit ("mouth-open"), mixed by ethnicity.
std::vector<TargetShare> UnitShares(const CastLibrary& library,
                                    const CastRecipe& recipe,
                                    std::string_view unit);

// What weighted targets add to every base vertex: metres, actor frame (Y up, facing -Z).
std::vector<glm::vec3> TargetDeltas(const CastLibrary& library,
                                    std::span<const TargetShare> shares);

// Every base vertex of the person: metres, actor frame, soles of the body at y = 0.
Result<std::vector<glm::vec3>> ShapeBase(const CastLibrary& library, const CastRecipe& recipe);

// The base mesh as it is stored, in metres and the actor frame.
std::vector<glm::vec3> UnshapedBase(const CastLibrary& library);

}  // namespace lararium::import
