#pragma once

// Tracks: sets of features in several images that show the same point.

#include <cstdint>
#include <span>
#include <vector>

#include "editor/train/matching.h"
#include "editor/train/pair_selection.h"
#include "shared/geometry/transform.h"

namespace lararium::train {

// Two images whose matches fit one two-view geometry.
struct VerifiedPair {
  ImagePair images;
  std::vector<FeatureMatch> matches;
  geometry::Rigid3 b_from_a;  // The baseline has length 1.
  double median_angle = 0.0;  // Median angle between the two rays to a point, radians.
};

struct TrackElement {
  uint32_t image = 0;
  uint32_t feature = 0;
};

// Track t is elements[begin[t], begin[t + 1]), sorted by image. An image occurs at most once in a
// track, and a feature belongs to at most one track.
struct Tracks {
  std::vector<uint32_t> begin = {0};
  std::vector<TrackElement> elements;

  size_t size() const { return begin.size() - 1; }
  std::span<const TrackElement> operator[](size_t track) const {
    return std::span(elements).subspan(begin[track], begin[track + 1] - begin[track]);
  }
};

// Joins matches into tracks, beginning with the pairs that have the most matches. A match that
// would put two features of one image into a track is left out. feature_counts: [images].
Tracks BuildTracks(std::span<const uint32_t> feature_counts, std::span<const VerifiedPair> pairs);

}  // namespace lararium::train
