#pragma once

// Pictures of materials whose detail is finer than the vertices of what is made of
// them. They tile.

#include "shared/human/material.h"
#include "shared/stage/prop.h"

namespace lararium::import {

// Sawn wood: a metre along the grain by a quarter of a metre across it.
human::Texture WoodGrain();
// Woven rods, bent round stakes: four rods and four stakes.
human::Texture WickerWeave();

// Texture coordinates for them. grain_axis: 0 x, 1 y, 2 z of the part.
void PanelWithWood(int grain_axis, stage::PropMesh& mesh);
void WeaveOfWicker(stage::PropMesh& mesh);  // of what is round

}  // namespace lararium::import
