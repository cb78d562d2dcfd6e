#pragma once

// The pose of one image from its features, without a prior: search in the
// forest, preemptive RANSAC with P3P, refinement, guided matching, refinement.

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "shared/geometry/camera_model.h"
#include "shared/geometry/preemptive_ransac.h"
#include "shared/geometry/transform.h"
#include "shared/vision/confidence.h"
#include "shared/vision/descriptor_forest.h"
#include "shared/vision/features.h"
#include "shared/vision/guided_matcher.h"
#include "shared/vision/pose_refinement.h"
#include "shared/vision/scene_database.h"
#include "shared/vision/tracked_frame.h"

namespace lararium::vision {

struct LocalizerOptions {
  int search_checks = 64;  // descriptors looked at for each query
  float ratio = 0.8f;      // Lowe's ratio between different points
  float inlier_threshold_px = 2.0f;
  int hypotheses = 512;  // of preemptive RANSAC
  int min_inliers = 15;
  uint64_t seed = 1;
};

struct Location {
  std::optional<geometry::Rigid3> camera_from_map;
  TrackReason reason = TrackReason::kNone;  // why there is no pose
  int matches = 0;                          // found without a prior
  int inliers = 0;                          // of guided matching
  // Of (w, v) in the pose (exp(w) R, exp(w) t + v); map units.
  Matrix6d covariance = Matrix6d::Zero();
  // One sigma of where the pose puts things, root mean square over the image.
  double expected_error_px = 0.0;
  // The probability that this error is below a pixel; 0 without a pose.
  float confidence = 0.0f;
};

// A point of the map where a feature showed it, in agreement with the pose.
struct LocatedPoint {
  uint32_t point = 0;
  float sigma_px = 0.0f;                            // along one axis
  Eigen::Vector2f pixel = Eigen::Vector2f::Zero();  // raw
};

class Localizer {
 public:
  // Borrows the database for its life.
  Localizer(const SceneDatabase& database, const LocalizerOptions& options);

  // The same features give the same pose, whatever came before.
  Location Locate(const Features& features, const geometry::CameraModel& camera);

  // What the last location stands on, the most exact first; nothing without a pose.
  std::span<const LocatedPoint> points() const { return points_; }

 private:
  static constexpr uint32_t kNoMatch = 0xffffffff;

  struct Match : FeatureMatch {
    float ratio = 1.0f;  // to the distance of the nearest other point, squared
  };

  void OrderQueries(const Features& features);
  // Searches for the features queries_[begin, end) and adds what it finds.
  void SearchMatches(const Features& features, size_t begin, size_t end);
  // From the matches that were found so far; whether there is a pose.
  bool LocateFromMatches(const Features& features,
                         const geometry::CameraModel& camera,
                         Location& location);
  bool IsNoAccident(const Features& features, const geometry::CameraModel& camera);
  std::optional<Match> SearchMatch(const Features& features,
                                   uint32_t feature,
                                   ForestSearcher& searcher) const;
  void KeepBestOfEachPoint();
  template <typename M>
  void FillPoseMatches(const Features& features, const std::vector<M>& matches);
  std::optional<geometry::Rigid3> FindPose(const geometry::CameraModel& camera);
  std::array<double, 3> Depths();
  bool Judge(const geometry::CameraModel& camera, Location& location);
  void FillPoints(const Features& features);

  const SceneDatabase& database_;
  LocalizerOptions options_;
  GuidedMatcher guided_;

  // Working memory.
  std::vector<Eigen::Vector2d> planes_;  // of the features, undistorted
  std::vector<ForestSearcher> searchers_;
  std::vector<uint32_t> queries_;            // features, those searched first before the others
  std::vector<uint32_t> place_in_tile_;      // [features]: rank by strength in its tile
  std::vector<uint32_t> counts_;             // of features or inliers in tiles
  std::vector<std::optional<Match>> found_;  // [features]
  std::vector<Match> matches_;               // most distinctive first
  std::vector<uint32_t> match_of_point_;     // into matches_
  std::vector<FeatureMatch> guided_matches_;
  std::vector<PoseMatch> pose_matches_;
  geometry::PreemptiveRansac<Eigen::Matrix<double, 3, 4>> ransac_;
  PoseRefiner refiner_;
  RefinedPose refined_;
  std::vector<LocatedPoint> points_;
  std::vector<double> depths_;
  std::vector<uint32_t> spots_;  // of the inliers
};

}  // namespace lararium::vision
