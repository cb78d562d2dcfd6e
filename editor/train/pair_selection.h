#pragma once

// Selects the image pairs that are worth matching.

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

struct PairSelection {
  std::vector<ImagePair> pairs;  // Sorted, without duplicates.
  bool ordered = false;          // Most images look like the next one, as in a film.
};

struct PairOptions {
  uint32_t exhaustive_up_to = 50;  // Up to this many images, all pairs are matched.
  // The following three apply to a source in which neighbouring images look alike, such as a video.
  std::vector<uint32_t> gaps = {1, 2, 4, 7};  // Index differences of matched pairs, ascending.
  uint32_t apart = 5;    // Minimum index difference between two images similar to a third one.
  uint32_t similar = 5;  // Number of most similar images per image, beyond the largest gap.
  // Number of most similar images per image of an unordered source.
  uint32_t similar_unordered = 20;
  uint64_t seed = 1;
};

// Selects neighbours in the source, if neighbours look alike, and pairs of similar appearance by
// vectors of locally aggregated descriptors (Jegou et al., "Aggregating local descriptors into a
// compact image representation", CVPR 2010).
PairSelection SelectPairs(std::span<const vision::Features> images, const PairOptions& options);

}  // namespace lararium::train
