#pragma once

// Hair that hangs free of the head (tails, braids, long locks) and the ends of belts swing:
// they get joints of their own, along their own shape.

#include <vector>

#include "editor/import/cast_parts.h"

namespace lararium::import {

// Finds the bundles of connected surfaces that hang free, lays a chain of joints along the
// middle of each from where it leaves the head, and hands its vertices over to the chain.
// The joints come last in the skeleton, which must be one of body; the bind pose stays as it
// is. Returns the chains: none where nothing hangs.
std::vector<human::SpringChain> HangHair(CastPiece& hair,
                                         const FittedBody& body,
                                         human::Skeleton& skeleton);

// Likewise the ends of belts and cords: what is long, thin, hangs and belongs to no cloth.
std::vector<human::SpringChain> HangTails(Garment& garment, human::Skeleton& skeleton);

}  // namespace lararium::import
