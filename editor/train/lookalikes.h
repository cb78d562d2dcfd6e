#pragma once

// Finds the points of a map that look like points of another part of the place: the bays of a hall,
// the columns of a portico, the two sides of a symmetric room.

#include <cstdint>
#include <vector>

#include "shared/vision/scene_database.h"

namespace lararium::train {

// See SceneDatabase::lookalikes, which the result is for. Searches for rigid motions that lay much
// of what a keyframe sees onto other points with similar descriptors. Points that were not found
// again count as their neighbours in the image do, because no map has every point of every part.
// Needs the forest of the database.
std::vector<uint8_t> FindLookalikes(const vision::SceneDatabase& database, uint64_t seed);

}  // namespace lararium::train
