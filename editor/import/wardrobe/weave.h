#pragma once

// Tileable images of woven cloth, made of noise and threads.

#include <cstdint>

#include "shared/core/status.h"
#include "shared/human/material.h"

namespace lararium::import {

inline constexpr float kWeaveTile = 0.24f;  // Metres that an image spans.

enum class Weave : uint8_t { kWool, kLinen, kLeather };

// Nearly white, because the albedo of the vertices holds the dye.
Result<human::Texture> WeaveColour(Weave weave, uint64_t seed);
Result<human::Texture> WeaveNormals(Weave weave, uint64_t seed);

}  // namespace lararium::import
