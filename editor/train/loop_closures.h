#pragma once

// Tells true returns of a film to a part of the place from views of another part that looks the
// same, such as the next bay of a hall.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "editor/train/reconstruction.h"
#include "editor/train/tracks.h"

namespace lararium::train {

struct LoopClosures {
  std::vector<VerifiedPair> pairs;  // The pairs to map, in the given order.
  size_t lookalikes = 0;            // Number of pairs that show different parts of the place.
};

// chain is a map of the pairs whose indices differ by no more than film_gap. Such a map drifts
// slowly, because neighbouring images show the same part of the place. A pair farther apart closes
// a loop if both of its images place what they have in common where the drift allows it. If some
// pairs only look alike, pairs that the chain cannot judge are left out too.
LoopClosures JudgeLoopClosures(std::span<const VerifiedPair> pairs,
                               uint32_t film_gap,
                               const Reconstruction& chain);

}  // namespace lararium::train
