#pragma once

// Which way a figure stands in the axes of its file.

#include <glm/mat3x3.hpp>
#include <optional>

#include "editor/import/bone_map.h"

namespace lararium::import {

struct FigureFrame {
  glm::mat3 actor_from_scene = glm::mat3(1.0f);  // a rotation: Y up, facing -Z
  bool sides_fit_feet = true;  // false: the feet point the other way than left and right say
};

// From the mapped joints: up from ankles to head, right from left to right limbs; snapped
// to the axes of the file where these are meant. Empty where the map is no human, or flat.
std::optional<FigureFrame> FindFigureFrame(const Rig& rig, const BoneMap& map);

}  // namespace lararium::import
