#pragma once

// Where a skin takes the sun, and where its pictures hold more shade than skin has.

#include <vector>

#include "editor/import/cast_parts.h"

namespace lararium::import {

// Of each vertex of the skin, 0..amount: over nose and cheeks, fading around them.
std::vector<float> WhereFrecklesAre(const FittedBody& body, const CastPiece& skin, float amount);

// Of each vertex of the skin, 0..amount: what faces the sky on head, neck, forearms and hands.
std::vector<float> WhereTheSunBurns(const FittedBody& body, const CastPiece& skin, float amount);

// Of each vertex of the skin, 0..1: on lids and in eye sockets, fading around them; and on
// the cheeks below, whose colour lids have.
std::vector<float> WhereLidsAre(const FittedBody& body, const CastPiece& skin);
std::vector<float> WhereCheeksAre(const FittedBody& body, const CastPiece& skin);

}  // namespace lararium::import
