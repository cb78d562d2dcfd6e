#pragma once

// Adds joints along hair that hangs free of the head (tails, braids, long locks) and along the
// ends of belts, so that they swing.

#include <vector>

#include "editor/import/cast/cast_parts.h"

namespace lararium::import {

// Finds the bundles of connected surfaces that hang free, puts a chain of joints along the
// middle of each, starting where it leaves the head, and binds its vertices to the chain. The
// joints are appended to `skeleton`, which must be that of `body`; the bind pose does not
// change. Returns the chains; empty if nothing hangs.
std::vector<human::SpringChain> HangHair(CastPiece& hair,
                                         const FittedBody& body,
                                         human::Skeleton& skeleton);

// Does the same for ends of belts and cords: parts that are long and thin, hang, and belong to
// no cloth.
std::vector<human::SpringChain> HangTails(Garment& garment, human::Skeleton& skeleton);

}  // namespace lararium::import
