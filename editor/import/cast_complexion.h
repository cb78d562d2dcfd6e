#pragma once

// Where a skin takes the sun.

#include <vector>

#include "editor/import/cast_parts.h"

namespace lararium::import {

// Of each vertex of the skin, 0..amount: over nose and cheeks, fading around them.
std::vector<float> WhereFrecklesAre(const FittedBody& body, const CastPiece& skin, float amount);

// Of each vertex of the skin, 0..amount: what faces the sky on head, neck, forearms and hands.
std::vector<float> WhereTheSunBurns(const FittedBody& body, const CastPiece& skin, float amount);

}  // namespace lararium::import
