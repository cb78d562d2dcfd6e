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
  uint32_t exhaustive_up_to = 50;  // images; so few are all matched with one another
  // Of an ordered source:
  std::vector<uint32_t> gaps = {1, 2, 4, 7};  // to following images, ascending
  uint32_t apart = 5;    // images, between any two that are taken as similar to a third
  uint32_t similar = 5;  // images that look most alike, further away than the gaps
  // Of an unordered one:
  uint32_t similar_unordered = 20;
  uint64_t seed = 1;
};

// Neighbours in the source, where neighbours look alike, and pairs of similar
// appearance by vectors of locally aggregated descriptors (Jegou et al.,
// "Aggregating local descriptors into a compact image representation", CVPR
// 2010). Sorted, without duplicates.
std::vector<ImagePair> SelectPairs(std::span<const vision::Features> images,
                                   const PairOptions& options);

}  // namespace lararium::train
