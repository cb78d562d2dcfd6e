#pragma once

// Pictures of woven cloth, made of noise and threads: tileable.

#include <cstdint>

#include "editor/import/garment/garment_pattern.h"
#include "shared/core/status.h"
#include "shared/human/material.h"

namespace lararium::import {

inline constexpr float kWeaveTile = 0.24f;  // metres that a picture spans

enum class Weave : uint8_t { kWool, kLinen, kLeather };

Weave WeaveOf(const GarmentPattern& pattern);

// Near white: the dye is the vertices' albedo.
Result<human::Texture> WeaveColour(Weave weave, uint64_t seed);
Result<human::Texture> WeaveNormals(Weave weave, uint64_t seed);

}  // namespace lararium::import
