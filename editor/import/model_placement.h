#pragma once

// How a scene becomes one in the actor frame: its axes turned, its unit made the metre, the
// figure put where actors stand.

#include <glm/mat4x4.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "editor/import/model_parts.h"
#include "editor/import/model_rig.h"
#include "editor/import/model_scene.h"

namespace lararium::import {

// actor_from_scene, a similarity. parts: empty where only the motion is wanted; the rig's
// bones tell its size then. The unit is the one asked for (metres_per_unit), else the one
// that the file states, else for people the one that gives a possible height. People are
// put on the floor, and over the origin where their hips are further than 0.25 m from it.
// Guesses are added to the notes. Errors: a figure without height.
Result<glm::mat4> PlaceFigure(const ModelScene& model,
                              std::span<const Part> parts,
                              const ModelRig& rig,
                              std::optional<float> metres_per_unit,
                              std::vector<std::string>& notes);

}  // namespace lararium::import
