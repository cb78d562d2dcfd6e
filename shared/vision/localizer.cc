#include "shared/vision/localizer.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "shared/core/parallel.h"
#include "shared/geometry/p3p.h"

namespace lararium::vision {
namespace {

using geometry::CameraModel;
using geometry::Rigid3;

constexpr size_t kNeighbours = 8;    // of a query: usually more than one point's descriptors
constexpr size_t kSearchJobs = 8;    // each with its own searcher
constexpr size_t kLeastMatches = 6;  // below, three that agree mean nothing
constexpr double kGuidedRadiusPx = 3.0;
constexpr double kLargestErrorPx = 3.0;  // expected, of a pose worth showing

// Relative uncertainty of where a feature shows a point. Measured on sequences
// with true poses: it grows with the feature's scale and with the distance of
// the descriptors, and the point itself is the better known the more often
// training saw it.
double SigmaOf(const Keypoint& keypoint, uint32_t squared_distance, uint32_t observations) {
  constexpr double kScale = 3.0;  // pixels
  constexpr double kDistance = 18000.0;
  constexpr double kObservations = 10.0;
  const double s = keypoint.scale / kScale;
  const double d = 1.0 + squared_distance / kDistance;
  return std::sqrt((1.0 + s * s) * d * d + kObservations / std::max(observations, 1u));
}

}  // namespace

Localizer::Localizer(const SceneDatabase& database, const LocalizerOptions& options)
    : database_(database),
      options_(options),
      guided_(database),
      match_of_point_(database.points.size(), kNoMatch) {
  for (size_t i = 0; i < kSearchJobs; ++i) {
    searchers_.emplace_back(database.forest, database.descriptors);
  }
}

Location Localizer::Locate(const Features& features, const CameraModel& camera) {
  Location location;
  location.reason = TrackReason::kTooFewFeatures;
  if (features.size() < static_cast<size_t>(options_.min_inliers)) {
    return location;
  }
  planes_.resize(features.size());
  for (size_t i = 0; i < features.size(); ++i) {
    planes_[i] = camera.PlaneFromPixel({features.keypoints[i].x, features.keypoints[i].y});
  }
  SearchMatches(features);
  location.matches = static_cast<int>(matches_.size());
  location.reason = TrackReason::kTooFewMatches;
  if (matches_.size() < kLeastMatches) {
    return location;
  }
  location.reason = TrackReason::kNoConsistentPose;
  FillPoseMatches(features, matches_);
  const std::optional<Rigid3> first = FindPose(camera);
  if (!first) {
    return location;
  }
  const RefinementOptions refinement{camera.Focal(), options_.inlier_threshold_px};
  refiner_.Refine(pose_matches_, refinement, *first, refined_);
  if (refined_.inliers.size() < kLeastMatches) {
    return location;
  }
  guided_.Match(camera, refined_.camera_from_map, features, kGuidedRadiusPx, guided_matches_);
  FillPoseMatches(features, guided_matches_);
  refiner_.Refine(pose_matches_, refinement, refined_.camera_from_map, refined_);
  Judge(camera, location);
  return location;
}

void Localizer::Judge(const CameraModel& camera, Location& location) {
  location.inliers = static_cast<int>(refined_.inliers.size());
  if (location.inliers < options_.min_inliers) {
    return;
  }
  const PoseEvidence evidence{
      .covariance = refined_.covariance, .depths = Depths(), .inliers = location.inliers};
  const double error = std::sqrt(ComputeRegistrationVariance(camera, evidence).Sum());
  if (!(error < kLargestErrorPx)) {
    return;
  }
  location.camera_from_map = refined_.camera_from_map;
  location.covariance = refined_.covariance;
  location.reason = TrackReason::kNone;
  location.expected_error_px = error;
  location.confidence = static_cast<float>(PoseConfidence(camera, evidence));
}

template <typename M>
void Localizer::FillPoseMatches(const Features& features, const std::vector<M>& matches) {
  pose_matches_.clear();
  for (const FeatureMatch& match : matches) {
    pose_matches_.push_back({database_.points[match.point].cast<double>(), planes_[match.feature],
                             SigmaOf(features.keypoints[match.feature], match.squared_distance,
                                     database_.observation_counts[match.point])});
  }
}

std::optional<Localizer::Match> Localizer::SearchMatch(const Features& features,
                                                       uint32_t feature,
                                                       ForestSearcher& searcher) const {
  std::array<Neighbour, kNeighbours> neighbours;
  const size_t count =
      searcher.Search(features.descriptors[feature], options_.search_checks, neighbours);
  if (count == 0) {
    return std::nullopt;
  }
  const uint32_t point = database_.descriptor_point[neighbours[0].descriptor];
  // Where all neighbours show the same point, another is at least as far as the last.
  uint32_t other = neighbours[count - 1].squared_distance;
  for (size_t i = 1; i < count; ++i) {
    if (database_.descriptor_point[neighbours[i].descriptor] != point) {
      other = neighbours[i].squared_distance;
      break;
    }
  }
  const float ratio =
      static_cast<float>(neighbours[0].squared_distance) / static_cast<float>(std::max(other, 1u));
  if (ratio >= options_.ratio * options_.ratio) {
    return std::nullopt;
  }
  return Match{{feature, point, neighbours[0].squared_distance}, ratio};
}

void Localizer::SearchMatches(const Features& features) {
  found_.assign(features.size(), std::nullopt);
  ParallelFor(kSearchJobs, [&](size_t job) {
    const size_t end = features.size() * (job + 1) / kSearchJobs;
    for (size_t f = features.size() * job / kSearchJobs; f < end; ++f) {
      found_[f] = SearchMatch(features, static_cast<uint32_t>(f), searchers_[job]);
    }
  });
  KeepBestOfEachPoint();
  std::sort(matches_.begin(), matches_.end(), [](const Match& a, const Match& b) {
    return a.ratio != b.ratio ? a.ratio < b.ratio : a.feature < b.feature;
  });
}

void Localizer::KeepBestOfEachPoint() {
  matches_.clear();
  for (const std::optional<Match>& match : found_) {
    if (!match) {
      continue;
    }
    uint32_t& known = match_of_point_[match->point];
    if (known == kNoMatch) {
      known = static_cast<uint32_t>(matches_.size());
      matches_.push_back(*match);
    } else if (match->squared_distance < matches_[known].squared_distance) {
      matches_[known] = *match;
    }
  }
  for (const Match& match : matches_) {
    match_of_point_[match.point] = kNoMatch;
  }
}

std::optional<Rigid3> Localizer::FindPose(const CameraModel& camera) {
  using Pose = Eigen::Matrix<double, 3, 4>;
  const auto count = static_cast<uint32_t>(matches_.size());
  // The first samples come from the most distinctive matches, later ones from
  // more and more (after Chum & Matas, "Matching with PROSAC", CVPR 2005).
  constexpr uint32_t kFirstPool = 12;
  uint32_t samples = 0;
  const auto generate = [&](Random& random, std::vector<Pose>& poses) {
    const uint32_t grown = kFirstPool + 4 * count * samples / (3 * options_.hypotheses);
    const uint32_t pool = std::min(grown, count);
    ++samples;
    std::array<Eigen::Vector3d, 3> rays;
    std::array<Eigen::Vector3d, 3> points;
    for (int i = 0; i < 3; ++i) {
      const PoseMatch& match = pose_matches_[random.Below(pool)];
      rays[i] = match.plane.homogeneous().normalized();
      points[i] = match.point;
    }
    const geometry::P3pSolutions solutions = geometry::SolveP3p(rays, points);
    for (const Rigid3& pose : solutions.poses()) {
      poses.push_back(pose.Matrix3x4());
    }
  };
  const double focal2 = camera.Focal() * camera.Focal();
  const double limit = std::pow(2.0 * options_.inlier_threshold_px, 2);
  const auto cost = [&](const Pose& pose, uint32_t i) {
    const PoseMatch& match = pose_matches_[i];
    const Eigen::Vector3d p = pose.leftCols<3>() * match.point + pose.col(3);
    if (p.z() <= 0.0) {
      return limit;
    }
    const double square = (p.hnormalized() - match.plane).squaredNorm() * focal2;
    return std::min(square, limit);
  };
  const geometry::PreemptiveRansacOptions ransac_options{.hypotheses = options_.hypotheses,
                                                         .seed = options_.seed};
  const auto winner = ransac_.Run(count, ransac_options, generate, cost);
  if (!winner) {
    return std::nullopt;
  }
  const Pose& pose = winner->hypothesis;
  return Rigid3::FromMatrix(pose.leftCols<3>(), pose.col(3));
}

// Quartiles of the inliers' distances.
std::array<double, 3> Localizer::Depths() {
  depths_.clear();
  for (const uint32_t i : refined_.inliers) {
    depths_.push_back((refined_.camera_from_map * pose_matches_[i].point).z());
  }
  std::sort(depths_.begin(), depths_.end());
  return {depths_[depths_.size() / 4], depths_[depths_.size() / 2],
          depths_[depths_.size() * 3 / 4]};
}

}  // namespace lararium::vision
