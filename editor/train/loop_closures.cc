#include "editor/train/loop_closures.h"

#include <Eigen/Core>
#include <algorithm>
#include <optional>

#include "shared/core/median.h"

namespace lararium::train {
namespace {

constexpr double kDrift = 0.05;       // Largest drift, as a share of the way between two images.
constexpr double kDepthError = 0.03;  // Error of a point, as a share of its depth.
constexpr size_t kFewPoints = 8;      // Fewer common points prove nothing.

class Judge {
 public:
  explicit Judge(const Reconstruction& chain) : chain_(chain), track_of_(chain.image_count()) {
    Eigen::Vector3d last = Eigen::Vector3d::Zero();
    double way = 0.0;
    for (uint32_t image = 0; image < chain.image_count(); ++image) {
      for (const uint32_t element : chain.ElementsOf(image)) {
        const uint32_t feature = chain.tracks().elements[element].feature;
        if (chain.Observed(element)) {
          std::vector<uint32_t>& tracks = track_of_[image];
          tracks.resize(std::max<size_t>(tracks.size(), feature + 1), kNone);
          tracks[feature] = chain.TrackOf(element);
        }
      }
      if (chain.Located(image)) {
        const Eigen::Vector3d centre = chain.camera_from_map(image).Center();
        way += way_.empty() ? 0.0 : (centre - last).norm();
        last = centre;
      }
      way_.push_back(way);
    }
  }

  // Whether both images show the same part of the place; nullopt if the chain does not say so.
  std::optional<bool> SamePart(const VerifiedPair& pair) const {
    const auto [a, b] = pair.images;
    std::vector<double> distances;
    std::vector<double> depths;
    for (const FeatureMatch& match : pair.matches) {
      const uint32_t in_a = TrackOf(a, match.a);
      const uint32_t in_b = TrackOf(b, match.b);
      if (in_a != kNone && in_b != kNone) {
        distances.push_back((chain_.Point(in_a) - chain_.Point(in_b)).norm());
        depths.push_back((chain_.camera_from_map(a) * chain_.Point(in_a)).z());
      }
    }
    if (distances.size() < kFewPoints) {
      return std::nullopt;
    }
    return Median(std::move(distances)) <
           kDrift * (way_[b] - way_[a]) + kDepthError * Median(std::move(depths));
  }

 private:
  static constexpr uint32_t kNone = 0xffffffff;

  uint32_t TrackOf(uint32_t image, uint32_t feature) const {
    return feature < track_of_[image].size() ? track_of_[image][feature] : kNone;
  }

  const Reconstruction& chain_;
  std::vector<std::vector<uint32_t>> track_of_;  // [image][feature]: Track, or kNone.
  std::vector<double> way_;  // [image]: Length of the camera's way from the first image.
};

}  // namespace

LoopClosures JudgeLoopClosures(std::span<const VerifiedPair> pairs,
                               uint32_t film_gap,
                               const Reconstruction& chain) {
  const Judge judge(chain);
  LoopClosures closures;
  std::vector<VerifiedPair> unknown;
  for (const VerifiedPair& pair : pairs) {
    if (pair.images.b - pair.images.a <= film_gap) {
      closures.pairs.push_back(pair);
      continue;
    }
    const std::optional<bool> same = judge.SamePart(pair);
    if (same.value_or(false)) {
      closures.pairs.push_back(pair);
    } else if (same) {
      ++closures.lookalikes;
    }
  }
  if (closures.lookalikes == 0) {
    closures.pairs.assign(pairs.begin(), pairs.end());
  }
  return closures;
}

}  // namespace lararium::train
