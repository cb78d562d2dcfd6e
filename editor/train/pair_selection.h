#pragma once

// Which image pairs are worth matching.

#include <cstdint>
#include <span>
#include <vector>

#include "shared/vision/features.h"

namespace lararium::train {

// Two images, a < b.
struct ImagePair {
  uint32_t a = 0;
  uint32_t b = 0;
  friend auto operator<=>(const ImagePair&, const ImagePair&) = default;
};

struct PairOptions {
  uint32_t exhaustive_up_to = 25;  // images; so few are all matched with one another
  uint32_t neighbours = 8;         // following images, in the order of the source
  uint32_t similar = 12;           // images that look most alike, elsewhere in the source
  uint64_t seed = 1;
};

// Neighbours in the source, and pairs of similar appearance by vectors of
// locally aggregated descriptors (Jegou et al., "Aggregating local descriptors
// into a compact image representation", CVPR 2010). Sorted, without duplicates.
std::vector<ImagePair> SelectPairs(std::span<const vision::Features> images,
                                   const PairOptions& options);

}  // namespace lararium::train
