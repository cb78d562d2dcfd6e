#pragma once

// Transforms a scene to the actor frame: rotates its axes, converts its unit to metres, and
// moves the figure to the origin.

#include <glm/mat4x4.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "editor/import/model/model_parts.h"
#include "editor/import/model/model_rig.h"
#include "editor/import/model/model_scene.h"

namespace lararium::import {

// Gives actor_from_scene, a similarity. `parts` is empty if only motion is imported; then the
// bones of the rig determine the size. The unit is `metres_per_unit` if given, otherwise the
// unit stated in the file, otherwise for people one that results in a plausible height. People
// are moved to the floor, and over the origin if their hips are more than 0.25 m from it.
// Guesses are listed in `notes`. Errors: a figure without height.
Result<glm::mat4> PlaceFigure(const ModelScene& model,
                              std::span<const Part> parts,
                              const ModelRig& rig,
                              std::optional<float> metres_per_unit,
                              std::vector<std::string>& notes);

}  // namespace lararium::import
