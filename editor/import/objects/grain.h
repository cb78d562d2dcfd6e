#pragma once

// Tileable images of materials whose detail is finer than the vertices of an object.

#include "shared/human/material.h"
#include "shared/stage/prop.h"

namespace lararium::import {

// Sawn wood: a metre along the grain by a quarter of a metre across it.
human::Texture WoodGrain();
// Woven rods, bent around stakes: four rods and four stakes.
human::Texture WickerWeave();

// Set texture coordinates for these images. `grain_axis` is 0 for x, 1 for y, 2 for z of the
// part.
void PanelWithWood(int grain_axis, stage::PropMesh& mesh);
void WeaveOfWicker(stage::PropMesh& mesh);  // Only for round parts.

}  // namespace lararium::import
