#pragma once

// Bakes the shadow inside the mouth, where light enters only between the lips.

#include <span>
#include <string>

#include "editor/import/cast/cast_parts.h"

namespace lararium::import {

// Darkens the vertex albedo of teeth, tongue and the lining of the mouth in proportion to the
// depth behind the front teeth. The first piece is the skin; `teeth` and `tongue` name theirs.
// Without teeth it does nothing.
void ShadeMouth(std::span<CastPiece> pieces, const std::string& teeth, const std::string& tongue);

}  // namespace lararium::import
