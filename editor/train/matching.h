#pragma once

// Matches between the descriptors of two images, by exhaustive search.

#include <cstdint>
#include <span>
#include <vector>

#include "shared/vision/features.h"

namespace lararium::train {

struct FeatureMatch {
  uint32_t a = 0;  // feature of the first image
  uint32_t b = 0;  // feature of the second image
  friend bool operator==(const FeatureMatch&, const FeatureMatch&) = default;
};

// Pairs that are each other's nearest neighbours and at a distance below ratio
// times that to the second nearest, in both directions (Lowe, IJCV 2004,
// section 7.1). In order of a.
std::vector<FeatureMatch> MatchDescriptors(std::span<const vision::Descriptor> a,
                                           std::span<const vision::Descriptor> b,
                                           float ratio);

// Indices of the up to count features of strongest response, ascending.
std::vector<uint32_t> StrongestFeatures(const vision::Features& features, size_t count);

// For each query the index of the nearest center, the first of equals.
std::vector<uint32_t> NearestCenters(std::span<const vision::Descriptor> queries,
                                     std::span<const vision::Descriptor> centers);

}  // namespace lararium::train
