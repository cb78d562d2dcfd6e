#pragma once

// Tracks: the features of several images that show one point.

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
  geometry::Rigid3 b_from_a;  // baseline of length 1
  double median_angle = 0.0;  // radians, between the two rays to a point
};

struct TrackElement {
  uint32_t image = 0;
  uint32_t feature = 0;
};

// Track t is elements[begin[t], begin[t + 1]), sorted by image; each image
// appears once in a track, each feature in one track at most.
struct Tracks {
  std::vector<uint32_t> begin = {0};
  std::vector<TrackElement> elements;

  size_t size() const { return begin.size() - 1; }
  std::span<const TrackElement> operator[](size_t track) const {
    return std::span(elements).subspan(begin[track], begin[track + 1] - begin[track]);
  }
};

// Joins matches into tracks. A match that would put two features of one image
// into a track is left out; pairs of most matches go first.
// feature_counts: of each image.
Tracks BuildTracks(std::span<const uint32_t> feature_counts, std::span<const VerifiedPair> pairs);

}  // namespace lararium::train
