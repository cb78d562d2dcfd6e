#include "editor/train/pair_verification.h"

#include <algorithm>
#include <functional>

#include "editor/train/guided_matching.h"
#include "editor/train/matching.h"
#include "editor/train/two_view.h"
#include "shared/core/parallel.h"

namespace lararium::train {
namespace {

using geometry::CameraModel;
using vision::Descriptor;
using vision::Features;

// Undistorted positions of an image's features on the plane z = 1.
std::vector<Eigen::Vector2d> Undistort(const Features& features, const CameraModel& camera) {
  std::vector<Eigen::Vector2d> points;
  points.reserve(features.size());
  for (const vision::Keypoint& keypoint : features.keypoints) {
    points.push_back(camera.PlaneFromPixel({keypoint.x, keypoint.y}));
  }
  return points;
}

std::vector<std::vector<Eigen::Vector2d>> UndistortAll(const CameraImages& images,
                                                       std::span<const TrainingCamera> cameras) {
  std::vector<std::vector<Eigen::Vector2d>> plane_points(images.features.size());
  ParallelFor(plane_points.size(), [&](size_t i) {
    plane_points[i] = Undistort(images.features[i], cameras[images.camera_of_image[i]].model);
  });
  return plane_points;
}

PointPairs PairUp(std::span<const std::vector<Eigen::Vector2d>> points,
                  const ImagePair& images,
                  std::span<const FeatureMatch> matches) {
  PointPairs pairs;
  for (const FeatureMatch& match : matches) {
    pairs.a.push_back(points[images.a][match.a]);
    pairs.b.push_back(points[images.b][match.b]);
  }
  return pairs;
}

std::vector<std::vector<Eigen::Vector2d>> PixelsOf(std::span<const Features> images) {
  std::vector<std::vector<Eigen::Vector2d>> pixels;
  for (const Features& features : images) {
    std::vector<Eigen::Vector2d>& of_image = pixels.emplace_back();
    for (const vision::Keypoint& keypoint : features.keypoints) {
      of_image.emplace_back(keypoint.x, keypoint.y);
    }
  }
  return pixels;
}

std::vector<FeatureMatch> Keep(std::span<const FeatureMatch> matches,
                               std::span<const uint32_t> indices) {
  std::vector<FeatureMatch> kept;
  for (const uint32_t i : indices) {
    kept.push_back(matches[i]);
  }
  return kept;
}

struct TwoViewGeometry {
  Eigen::Matrix3d fundamental;    // F with b' F a = 0 in the unit of the points.
  std::vector<uint32_t> inliers;  // Indices of the points.
  // The following two are set only if the points are on the plane z = 1.
  geometry::Rigid3 b_from_a;
  double median_angle = 0.0;
};
using EstimateGeometry =
    std::function<std::optional<TwoViewGeometry>(const ImagePair&, const PointPairs&)>;

// Matches pairs of images, beginning with the strongest features. If these determine the two-view
// geometry, the other features are searched along their epipolar lines only.
class PairMatcher {
 public:
  // points[i] are the positions of image i's features, in the unit that estimate expects. band is
  // the half width of the search along epipolar lines, in the same unit.
  PairMatcher(std::span<const Features> images,
              std::span<const std::vector<Eigen::Vector2d>> points,
              double band,
              const VerificationOptions& options,
              EstimateGeometry estimate)
      : images_(images),
        points_(points),
        band_(band),
        options_(options),
        estimate_(std::move(estimate)),
        previews_(images.size()),
        grids_(images.size()) {
    ParallelFor(images.size(), [&](size_t i) {
      previews_[i] = ChoosePreview(images_[i]);
      grids_[i].emplace(images_[i], points_[i]);
    });
  }

  // Matches and the two-view geometry that explains them.
  struct Found {
    std::vector<FeatureMatch> matches;
    TwoViewGeometry geometry;
  };
  std::optional<Found> Match(const ImagePair& pair) const {
    const std::vector<FeatureMatch> preview = MatchPreviews(pair);
    if (pair.b - pair.a > options_.trusted_gap && preview.size() < kPreviewMatches) {
      return std::nullopt;
    }
    if (preview.size() >= kFirmMatches) {
      std::optional<Found> found = Verify(pair, preview);
      if (found && found->matches.size() >= kFirmMatches) {
        const size_t before = found->matches.size();
        found = Verify(pair, MatchAlongLines(pair, *found));
        if (found && found->matches.size() >= before) {
          return found;
        }
      }
    }
    return Verify(pair, MatchDescriptors(images_[pair.a].descriptors, images_[pair.b].descriptors,
                                         options_.ratio));
  }

 private:
  static constexpr size_t kPreviewFeatures = 700;
  // Pairs with fewer matches of the preview features do not overlap. This test is cheap.
  static constexpr size_t kPreviewMatches = 10;
  static constexpr size_t kFirmMatches = 40;  // Enough to determine a two-view geometry.

  struct PreviewFeatures {
    std::vector<uint32_t> features;
    std::vector<Descriptor> descriptors;  // Parallel to features.
  };

  static PreviewFeatures ChoosePreview(const Features& features) {
    PreviewFeatures preview{StrongestFeatures(features, kPreviewFeatures), {}};
    for (const uint32_t i : preview.features) {
      preview.descriptors.push_back(features.descriptors[i]);
    }
    return preview;
  }

  std::vector<FeatureMatch> MatchPreviews(const ImagePair& pair) const {
    const PreviewFeatures& a = previews_[pair.a];
    const PreviewFeatures& b = previews_[pair.b];
    std::vector<FeatureMatch> matches =
        MatchDescriptors(a.descriptors, b.descriptors, options_.ratio);
    for (FeatureMatch& match : matches) {
      match = {a.features[match.a], b.features[match.b]};
    }
    return matches;
  }

  std::vector<FeatureMatch> MatchAlongLines(const ImagePair& pair, const Found& found) const {
    GuidedOptions guided;
    guided.fundamental = found.geometry.fundamental;
    guided.band = band_;
    guided.ratio = options_.ratio;
    MeasureTurnAndGrowth(images_[pair.a], images_[pair.b], found.matches, guided);
    return MatchGuided(*grids_[pair.a], *grids_[pair.b], guided);
  }

  std::optional<Found> Verify(const ImagePair& pair, std::span<const FeatureMatch> matches) const {
    if (matches.size() < options_.min_matches) {
      return std::nullopt;
    }
    std::optional<TwoViewGeometry> geometry = estimate_(pair, PointsOf(pair, matches));
    if (!geometry || geometry->inliers.size() < options_.min_matches) {
      return std::nullopt;
    }
    return Found{Keep(matches, geometry->inliers), std::move(*geometry)};
  }

  PointPairs PointsOf(const ImagePair& pair, std::span<const FeatureMatch> matches) const {
    return PairUp(points_, pair, matches);
  }

  std::span<const Features> images_;
  std::span<const std::vector<Eigen::Vector2d>> points_;
  double band_;
  VerificationOptions options_;
  EstimateGeometry estimate_;
  std::vector<PreviewFeatures> previews_;          // [image]
  std::vector<std::optional<FeatureGrid>> grids_;  // [image]
};

// Calls visit(i) for each of count candidates on all cores, until cancelled.
void ForCandidates(size_t count, Progress& progress, const std::function<void(size_t)>& visit) {
  constexpr size_t kBatch = 32;
  for (size_t begin = 0; begin < count && !progress.Cancelled(); begin += kBatch) {
    progress.Report("matching", static_cast<double>(begin) / static_cast<double>(count));
    ParallelFor(std::min(kBatch, count - begin), [&](size_t offset) { visit(begin + offset); });
  }
}

std::vector<VerifiedPair> Compact(std::vector<std::optional<VerifiedPair>> found) {
  std::vector<VerifiedPair> pairs;
  for (std::optional<VerifiedPair>& pair : found) {
    if (pair) {
      pairs.push_back(std::move(*pair));
    }
  }
  return pairs;
}

// The mean focal length of the cameras of a pair: turns pixels into lengths on the plane z = 1.
double FocalOf(const CameraImages& images,
               std::span<const TrainingCamera> cameras,
               const ImagePair& pair) {
  return 0.5 * (cameras[images.camera_of_image[pair.a]].model.Focal() +
                cameras[images.camera_of_image[pair.b]].model.Focal());
}

VerifiedPairs VerifyCalibrated(const CameraImages& images,
                               std::span<const ImagePair> candidates,
                               const VerificationOptions& options,
                               Progress& progress) {
  const auto plane_points = UndistortAll(images, images.cameras);
  const PairMatcher matcher(
      images.features, plane_points, options.band_px / images.cameras.front().model.Focal(),
      options,
      [&](const ImagePair& pair, const PointPairs& points) -> std::optional<TwoViewGeometry> {
        std::optional<RelativePose> pose = EstimateRelativePose(
            points, options.threshold_px / FocalOf(images, images.cameras, pair));
        if (!pose) {
          return std::nullopt;
        }
        return TwoViewGeometry{EssentialMatrix(pose->b_from_a), std::move(pose->inliers),
                               pose->b_from_a, pose->median_angle};
      });
  std::vector<std::optional<VerifiedPair>> found(candidates.size());
  ForCandidates(candidates.size(), progress, [&](size_t i) {
    auto match = matcher.Match(candidates[i]);
    if (match) {
      found[i] = VerifiedPair{candidates[i], std::move(match->matches), match->geometry.b_from_a,
                              match->geometry.median_angle};
    }
  });
  return {Compact(std::move(found)), {images.cameras.begin(), images.cameras.end()}};
}

double LongerSide(const TrainingCamera& camera) {
  const CameraModel model = ModelOfArea(camera);
  return std::max(model.width, model.height);
}

// A fundamental matrix of pixels, as one of positions relative to the principal points, in units of
// the images' longer sides.
Eigen::Matrix3d InSides(const Eigen::Matrix3d& fundamental,
                        const TrainingCamera& a,
                        const TrainingCamera& b) {
  const auto pixel_from_share = [](const TrainingCamera& camera) {
    const double side = LongerSide(camera);
    Eigen::Matrix3d k;
    k << side, 0, camera.model.cx, 0, side, camera.model.cy, 0, 0, 1;
    return k;
  };
  return pixel_from_share(b).transpose() * fundamental * pixel_from_share(a);
}

}  // namespace

VerifiedPairs VerifyPairs(const CameraImages& images,
                          std::span<const ImagePair> candidates,
                          const VerificationOptions& options,
                          Progress& progress) {
  if (std::all_of(images.cameras.begin(), images.cameras.end(),
                  [](const TrainingCamera& camera) { return camera.given; })) {
    return VerifyCalibrated(images, candidates, options, progress);
  }
  const auto pixels = PixelsOf(images.features);
  const PairMatcher matcher(
      images.features, pixels, options.band_px, options,
      [&](const ImagePair&, const PointPairs& points) -> std::optional<TwoViewGeometry> {
        std::optional<Fundamental> fundamental = EstimateFundamental(points, options.threshold_px);
        if (!fundamental) {
          return std::nullopt;
        }
        return TwoViewGeometry{fundamental->matrix, std::move(fundamental->inliers), {}, 0.0};
      });
  std::vector<std::optional<VerifiedPair>> found(candidates.size());
  std::vector<std::optional<Fundamental>> fundamentals(candidates.size());
  ForCandidates(candidates.size(), progress, [&](size_t i) {
    auto match = matcher.Match(candidates[i]);
    if (match) {
      found[i] = VerifiedPair{candidates[i], std::move(match->matches), {}, 0.0};
      fundamentals[i] =
          Fundamental{match->geometry.fundamental, std::move(match->geometry.inliers)};
    }
  });
  std::vector<TrainingCamera> cameras(images.cameras.begin(), images.cameras.end());
  std::vector<Fundamental> votes;
  for (size_t i = 0; i < found.size(); ++i) {
    if (found[i]) {
      const TrainingCamera& a = cameras[images.camera_of_image[candidates[i].a]];
      const TrainingCamera& b = cameras[images.camera_of_image[candidates[i].b]];
      if (!a.FocalKnown() && !b.FocalKnown()) {
        votes.push_back(*std::move(fundamentals[i]));
        votes.back().matrix = InSides(votes.back().matrix, a, b);
      }
    }
  }
  // Several cameras are people's phones, which see wide.
  const double share = EstimateFocal(votes).value_or(cameras.size() > 1 ? 0.8 : 1.2);
  for (TrainingCamera& camera : cameras) {
    if (!camera.FocalKnown()) {
      camera.model.fx = camera.model.fy = share * LongerSide(camera);
    }
  }
  const auto plane_points = UndistortAll(images, cameras);
  ParallelFor(found.size(), [&](size_t i) {
    if (!found[i]) {
      return;
    }
    // The threshold allows for the effect of a wrong focal length and distortion on true matches.
    const std::optional<RelativePose> pose = EstimateRelativePose(
        PairUp(plane_points, found[i]->images, found[i]->matches),
        2.0 * options.threshold_px / FocalOf(images, cameras, found[i]->images));
    if (pose && 2 * pose->inliers.size() >= found[i]->matches.size()) {
      found[i]->b_from_a = pose->b_from_a;
      found[i]->median_angle = pose->median_angle;
    }
  });
  return {Compact(std::move(found)), std::move(cameras)};
}

}  // namespace lararium::train
