#include "editor/train/pair_verification.h"

#include <algorithm>
#include <functional>

#include "editor/train/matching.h"
#include "editor/train/two_view.h"
#include "shared/core/parallel.h"

namespace lararium::train {
namespace {

using geometry::CameraModel;
using vision::Descriptor;
using vision::Features;

// What most pairs without overlap are told by, at a fraction of the work.
constexpr size_t kPreviewFeatures = 700;
constexpr size_t kPreviewMatches = 10;

std::vector<Descriptor> Preview(const Features& features) {
  std::vector<Descriptor> preview;
  for (const uint32_t i : StrongestFeatures(features, kPreviewFeatures)) {
    preview.push_back(features.descriptors[i]);
  }
  return preview;
}

// Matches candidates on all cores. verify(i, matches) sees each that has enough.
void MatchPairs(std::span<const Features> images,
                std::span<const ImagePair> candidates,
                const VerificationOptions& options,
                Progress& progress,
                const std::function<void(size_t, std::vector<FeatureMatch>)>& verify) {
  std::vector<std::vector<Descriptor>> previews(images.size());
  ParallelFor(images.size(), [&](size_t i) { previews[i] = Preview(images[i]); });
  constexpr size_t kBatch = 32;
  for (size_t begin = 0; begin < candidates.size() && !progress.Cancelled(); begin += kBatch) {
    progress.Report("matching",
                    static_cast<double>(begin) / static_cast<double>(candidates.size()));
    ParallelFor(std::min(kBatch, candidates.size() - begin), [&](size_t offset) {
      const auto [a, b] = candidates[begin + offset];
      if (b - a > options.trusted_gap &&
          MatchDescriptors(previews[a], previews[b], options.ratio).size() < kPreviewMatches) {
        return;
      }
      std::vector<FeatureMatch> matches =
          MatchDescriptors(images[a].descriptors, images[b].descriptors, options.ratio);
      if (matches.size() >= options.min_matches) {
        verify(begin + offset, std::move(matches));
      }
    });
  }
}

// Features of an image on the plane z = 1.
std::vector<Eigen::Vector2d> Undistort(const Features& features, const CameraModel& camera) {
  std::vector<Eigen::Vector2d> points;
  points.reserve(features.size());
  for (const vision::Keypoint& keypoint : features.keypoints) {
    points.push_back(camera.PlaneFromPixel({keypoint.x, keypoint.y}));
  }
  return points;
}

std::vector<std::vector<Eigen::Vector2d>> UndistortAll(std::span<const Features> images,
                                                       const CameraModel& camera) {
  std::vector<std::vector<Eigen::Vector2d>> plane_points(images.size());
  ParallelFor(images.size(), [&](size_t i) { plane_points[i] = Undistort(images[i], camera); });
  return plane_points;
}

PointPairs PlanePairs(std::span<const std::vector<Eigen::Vector2d>> plane_points,
                      const ImagePair& images,
                      std::span<const FeatureMatch> matches) {
  PointPairs pairs;
  for (const FeatureMatch& match : matches) {
    pairs.a.push_back(plane_points[images.a][match.a]);
    pairs.b.push_back(plane_points[images.b][match.b]);
  }
  return pairs;
}

PointPairs PixelPairs(std::span<const Features> images,
                      const ImagePair& pair,
                      std::span<const FeatureMatch> matches) {
  PointPairs pairs;
  for (const FeatureMatch& match : matches) {
    const vision::Keypoint& a = images[pair.a].keypoints[match.a];
    const vision::Keypoint& b = images[pair.b].keypoints[match.b];
    pairs.a.emplace_back(a.x, a.y);
    pairs.b.emplace_back(b.x, b.y);
  }
  return pairs;
}

std::vector<FeatureMatch> Keep(std::span<const FeatureMatch> matches,
                               std::span<const uint32_t> indices) {
  std::vector<FeatureMatch> kept;
  for (const uint32_t i : indices) {
    kept.push_back(matches[i]);
  }
  return kept;
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

CameraModel CentredCamera(int width, int height, double focal) {
  CameraModel camera;
  camera.width = width;
  camera.height = height;
  camera.fx = camera.fy = focal;
  camera.cx = 0.5 * (width - 1);
  camera.cy = 0.5 * (height - 1);
  return camera;
}

}  // namespace

std::vector<VerifiedPair> VerifyPairs(std::span<const Features> images,
                                      std::span<const ImagePair> candidates,
                                      const CameraModel& camera,
                                      const VerificationOptions& options,
                                      Progress& progress) {
  const auto plane_points = UndistortAll(images, camera);
  std::vector<std::optional<VerifiedPair>> found(candidates.size());
  MatchPairs(images, candidates, options, progress,
             [&](size_t i, const std::vector<FeatureMatch>& matches) {
               const std::optional<RelativePose> pose =
                   EstimateRelativePose(PlanePairs(plane_points, candidates[i], matches),
                                        options.threshold_px / camera.Focal());
               if (pose && pose->inliers.size() >= options.min_matches) {
                 found[i] = VerifiedPair{candidates[i], Keep(matches, pose->inliers),
                                         pose->b_from_a, pose->median_angle};
               }
             });
  return Compact(std::move(found));
}

VerifiedPairs VerifyPairsUncalibrated(std::span<const Features> images,
                                      std::span<const ImagePair> candidates,
                                      int width,
                                      int height,
                                      std::optional<double> focal_prior_px,
                                      const VerificationOptions& options,
                                      Progress& progress) {
  std::vector<std::optional<VerifiedPair>> found(candidates.size());
  std::vector<std::optional<Fundamental>> fundamentals(candidates.size());
  MatchPairs(
      images, candidates, options, progress,
      [&](size_t i, const std::vector<FeatureMatch>& matches) {
        fundamentals[i] =
            EstimateFundamental(PixelPairs(images, candidates[i], matches), options.threshold_px);
        if (fundamentals[i] && fundamentals[i]->inliers.size() >= options.min_matches) {
          found[i] = VerifiedPair{candidates[i], Keep(matches, fundamentals[i]->inliers), {}, 0.0};
        }
      });
  std::vector<Fundamental> votes;
  for (size_t i = 0; i < found.size(); ++i) {
    if (found[i]) {
      votes.push_back(*fundamentals[i]);
    }
  }
  if (!focal_prior_px) {
    focal_prior_px = EstimateFocal(votes, width, height);
  }
  const CameraModel camera =
      CentredCamera(width, height, focal_prior_px.value_or(1.2 * std::max(width, height)));
  const auto plane_points = UndistortAll(images, camera);
  ParallelFor(found.size(), [&](size_t i) {
    if (!found[i]) {
      return;
    }
    // Wide enough for what a wrong focal length and distortion do to true matches.
    const std::optional<RelativePose> pose =
        EstimateRelativePose(PlanePairs(plane_points, found[i]->images, found[i]->matches),
                             2.0 * options.threshold_px / camera.Focal());
    if (pose && 2 * pose->inliers.size() >= found[i]->matches.size()) {
      found[i]->b_from_a = pose->b_from_a;
      found[i]->median_angle = pose->median_angle;
    }
  });
  return {Compact(std::move(found)), camera};
}

}  // namespace lararium::train
