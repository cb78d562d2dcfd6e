#include "editor/train/tracks.h"

#include <algorithm>
#include <numeric>

#include "shared/core/check.h"

namespace lararium::train {
namespace {

bool ByImage(const TrackElement& a, const TrackElement& b) { return a.image < b.image; }

// Returns whether two lists, each sorted by image, have an image in common.
bool Overlap(std::span<const TrackElement> a, std::span<const TrackElement> b) {
  size_t j = 0;
  for (const TrackElement& element : a) {
    while (j < b.size() && b[j].image < element.image) {
      ++j;
    }
    if (j < b.size() && b[j].image == element.image) {
      return true;
    }
  }
  return false;
}

// Disjoint sets (union-find) of features with lists of their members.
class FeatureSets {
 public:
  explicit FeatureSets(std::span<const uint32_t> feature_counts) {
    first_.push_back(0);
    for (const uint32_t count : feature_counts) {
      first_.push_back(first_.back() + count);
    }
    parent_.resize(first_.back());
    std::iota(parent_.begin(), parent_.end(), 0u);
    members_.resize(first_.back());
  }

  uint32_t Id(uint32_t image, uint32_t feature) const {
    CHECK(first_[image] + feature < first_[image + 1]);
    return first_[image] + feature;
  }

  void Join(const TrackElement& a, const TrackElement& b) {
    uint32_t root_a = Touch(a);
    uint32_t root_b = Touch(b);
    if (root_a == root_b || Overlap(members_[root_a], members_[root_b])) {
      return;
    }
    if (members_[root_a].size() < members_[root_b].size()) {
      std::swap(root_a, root_b);
    }
    std::vector<TrackElement> merged(members_[root_a].size() + members_[root_b].size());
    std::merge(members_[root_a].begin(), members_[root_a].end(), members_[root_b].begin(),
               members_[root_b].end(), merged.begin(), ByImage);
    members_[root_a] = std::move(merged);
    members_[root_b] = {};
    parent_[root_b] = root_a;
  }

  // The sets with two or more members, in order of their roots.
  Tracks ToTracks() const {
    Tracks tracks;
    for (const auto& members : members_) {
      if (members.size() >= 2) {
        tracks.elements.insert(tracks.elements.end(), members.begin(), members.end());
        tracks.begin.push_back(static_cast<uint32_t>(tracks.elements.size()));
      }
    }
    return tracks;
  }

 private:
  uint32_t Touch(const TrackElement& element) {
    const uint32_t id = Id(element.image, element.feature);
    const uint32_t root = Root(id);
    if (members_[root].empty()) {
      members_[root].push_back(element);
    }
    return root;
  }

  uint32_t Root(uint32_t id) {
    while (parent_[id] != id) {
      parent_[id] = parent_[parent_[id]];
      id = parent_[id];
    }
    return id;
  }

  std::vector<uint32_t> first_;  // [images]: Id of the image's first feature.
  std::vector<uint32_t> parent_;
  std::vector<std::vector<TrackElement>> members_;  // [root]: Members sorted by image.
};

}  // namespace

Tracks BuildTracks(std::span<const uint32_t> feature_counts, std::span<const VerifiedPair> pairs) {
  std::vector<size_t> order(pairs.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](size_t i, size_t j) {
    return pairs[i].matches.size() > pairs[j].matches.size();
  });
  FeatureSets sets(feature_counts);
  for (const size_t i : order) {
    for (const FeatureMatch& match : pairs[i].matches) {
      sets.Join({pairs[i].images.a, match.a}, {pairs[i].images.b, match.b});
    }
  }
  return sets.ToTracks();
}

}  // namespace lararium::train
