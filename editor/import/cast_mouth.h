#pragma once

// The shadow inside the mouth: light comes in between the lips only.

#include <span>
#include <string>

#include "editor/import/cast_parts.h"

namespace lararium::import {

// Darkens teeth, tongue and the skin that lines the mouth by their vertex albedo: the more,
// the farther they lie behind the front teeth. skin: the first of the pieces; teeth and
// tongue by name, and nothing is done where there are no teeth.
void ShadeMouth(std::span<CastPiece> pieces, const std::string& teeth, const std::string& tongue);

}  // namespace lararium::import
