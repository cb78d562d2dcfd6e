#pragma once

// Matches the descriptors of two images by exhaustive search.

#include <cstdint>
#include <span>
#include <vector>

#include "shared/vision/features.h"

namespace lararium::train {

struct FeatureMatch {
  uint32_t a = 0;  // Feature of the first image.
  uint32_t b = 0;  // Feature of the second image.
  friend bool operator==(const FeatureMatch&, const FeatureMatch&) = default;
};

// Pairs of mutual nearest neighbours that pass the ratio test in both directions: their distance is
// below ratio times that to the second nearest (Lowe, IJCV 2004, section 7.1). Ordered by a.
std::vector<FeatureMatch> MatchDescriptors(std::span<const vision::Descriptor> a,
                                           std::span<const vision::Descriptor> b,
                                           float ratio);

// Indices of the `count` features of strongest response, or of all if there are fewer; ascending.
std::vector<uint32_t> StrongestFeatures(const vision::Features& features, size_t count);

// For each query, the index of the nearest center; the first one if several are equally near.
std::vector<uint32_t> NearestCenters(std::span<const vision::Descriptor> queries,
                                     std::span<const vision::Descriptor> centers);

}  // namespace lararium::train
