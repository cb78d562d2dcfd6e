#pragma once

// Finds which way a figure faces in the axes of its file.

#include <glm/mat3x3.hpp>
#include <optional>

#include "editor/import/model/bone_map.h"

namespace lararium::import {

struct FigureFrame {
  glm::mat3 actor_from_scene = glm::mat3(1.0f);  // A rotation to Y up, facing -Z.
  bool sides_fit_feet = true;  // False if the feet point opposite to what left and right imply.
};

// Uses the mapped joints: up is from ankles to head, right from left to right limbs; snaps to
// the axes of the file if they are nearly parallel. A figure that is posed, one of a motion, may
// face any way: then only up snaps, and its knees do not count. Gives nullopt if the map is not
// human or the figure is flat.
std::optional<FigureFrame> FindFigureFrame(const Rig& rig, const BoneMap& map, bool is_posed);

}  // namespace lararium::import
