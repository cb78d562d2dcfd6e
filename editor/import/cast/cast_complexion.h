#pragma once

// Masks for the complexion of a skin: where the sun reaches it, and where its image contains
// too much shade.

#include <vector>

#include "editor/import/cast/cast_parts.h"

namespace lararium::import {

// Values 0..amount for each vertex of the skin: freckles over nose and cheeks, fading around
// them.
std::vector<float> WhereFrecklesAre(const FittedBody& body, const CastPiece& skin, float amount);

// Values 0..amount for each vertex of the skin that faces the sky on head, neck, forearms and
// hands.
std::vector<float> WhereTheSunBurns(const FittedBody& body, const CastPiece& skin, float amount);

// Values 0..1 for each vertex of the skin: lids and eye sockets, fading around them; and the
// cheeks below, whose colour lids should have.
std::vector<float> WhereLidsAre(const FittedBody& body, const CastPiece& skin);
std::vector<float> WhereCheeksAre(const FittedBody& body, const CastPiece& skin);

}  // namespace lararium::import
