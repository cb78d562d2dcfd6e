#pragma once

// Estimates the pose of one image from its features, without a prior. Steps: search in the
// descriptor forest, preemptive RANSAC with P3P, refinement, guided matching, refinement.

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "shared/core/random.h"
#include "shared/geometry/camera_model.h"
#include "shared/geometry/preemptive_ransac.h"
#include "shared/geometry/transform.h"
#include "shared/vision/camera_estimate.h"
#include "shared/vision/camera_refinement.h"
#include "shared/vision/confidence.h"
#include "shared/vision/descriptor_forest.h"
#include "shared/vision/features.h"
#include "shared/vision/guided_matcher.h"
#include "shared/vision/pose_refinement.h"
#include "shared/vision/scene_database.h"
#include "shared/vision/tracked_frame.h"

namespace lararium::vision {

struct LocalizerOptions {
  int search_checks = 64;  // Descriptors compared per query.
  float ratio = 0.8f;      // Lowe's ratio test between the two nearest different points.
  float inlier_threshold_px = 2.0f;
  int hypotheses = 512;  // Number of hypotheses of preemptive RANSAC.
  int min_inliers = 15;
  uint64_t seed = 1;
};

// What is known of the camera that took an image.
struct CameraGuess {
  // All is known if the covariance is zero; otherwise the intrinsics are estimated with the pose.
  CameraEstimate prior;
  // Cameras that may have taken the image, if not all is known. They only propose poses.
  std::vector<geometry::CameraModel> candidates = {};
  // Where the camera probably is. Used only if the image is ambiguous.
  std::optional<geometry::Rigid3> predicted = std::nullopt;
};

struct Location {
  std::optional<geometry::Rigid3> camera_from_map;
  CameraEstimate camera;                    // The given one, or as estimated with the pose.
  TrackReason reason = TrackReason::kNone;  // Why there is no pose.
  int matches = 0;                          // Number of matches found without a prior.
  int inliers = 0;                          // Number of inliers after guided matching.
  // Covariance of (w, v) in the pose (exp(w) R, exp(w) t + v); radians and map units.
  Matrix6d covariance = Matrix6d::Zero();
  // Expected registration error of the pose, one sigma, root mean square over the image.
  double expected_error_px = 0.0;
  // Probability that the registration error is below 1 pixel; 0 without a pose.
  float confidence = 0.0f;
};

// A map point matched to a feature that agrees with the pose.
struct LocatedPoint {
  uint32_t point = 0;
  float sigma_px = 0.0f;                            // Standard deviation of `pixel` along one axis.
  Eigen::Vector2f pixel = Eigen::Vector2f::Zero();  // raw pixel
};

class Localizer {
 public:
  // The database must outlive the localizer.
  Localizer(const SceneDatabase& database, const LocalizerOptions& options);

  // Deterministic: the same features give the same pose, independent of earlier calls.
  Location Locate(const Features& features, const CameraGuess& guess);
  Location Locate(const Features& features, const geometry::CameraModel& camera) {
    return Locate(features, CameraGuess{ExactCamera(camera)});
  }

  // The points that support the last location, the most accurate first; empty without a pose.
  std::span<const LocatedPoint> points() const { return points_; }

 private:
  static constexpr uint32_t kNoMatch = 0xffffffff;

  // A pose with the focal length and the division of geometry::RadialPose.
  struct SeenPose {
    Eigen::Matrix<double, 3, 4> pose;
    double focal = 0.0;
    double division = 0.0;
  };

  struct Match : FeatureMatch {
    float ratio = 1.0f;  // Squared distance over that of the nearest other point.
  };

  void OrderQueries(const Features& features);
  // Searches for the features queries_[begin, end) and rebuilds matches_ from all that were found.
  void SearchMatches(const Features& features, size_t begin, size_t end);
  // Estimates the pose from matches_. Returns whether there is a pose.
  bool LocateFromMatches(const Features& features, const CameraGuess& guess, Location& location);
  // Estimates the pose from the points near the predicted one. Returns whether there is a pose.
  bool LocateAtPrediction(const Features& features, const CameraGuess& guess, Location& location);
  // Refines the pose of pose_matches_, and with it the camera unless it is known. Fills in
  // inliers_, noise_px_ and posed_.
  void Refine(const CameraGuess& guess);
  // Whether the inliers can hardly agree by chance. Points that have look-alikes do not count,
  // because they would agree with another pose as well.
  bool IsNoAccident(const Features& features, const CameraGuess& guess);
  // Whether the points without look-alikes were found about as often as the others, of
  // guided_matches_. In another part of the place they are missing.
  bool ShowsUniquePoints() const;
  // Whether most of what was recognised has look-alikes.
  bool IsAmbiguous() const;
  std::optional<Match> SearchMatch(const Features& features,
                                   uint32_t feature,
                                   ForestSearcher& searcher) const;
  void KeepMatches();
  template <typename M>
  void FillPoseMatches(const Features& features, const std::vector<M>& matches);
  std::optional<geometry::Rigid3> FindPose(const geometry::CameraModel& camera);
  std::optional<PosedCamera> FindPosedCamera(const CameraGuess& guess);
  // Draws the matches of one sample, first the most distinctive ones.
  template <size_t N>
  std::array<const PoseMatch*, N> DrawSample(uint32_t sample, Random& random) const;
  JointMatrix<kMostJoint> Covariance(const CameraGuess& guess) const;
  std::array<double, 3> Depths();
  bool Judge(const CameraGuess& guess, Location& location);
  void FillPoints(const Features& features);

  const SceneDatabase& database_;
  LocalizerOptions options_;
  GuidedMatcher guided_;

  // Working memory.
  std::vector<Eigen::Vector2d> planes_;  // [features]: Undistorted position on the plane z = 1.
  std::vector<ForestSearcher> searchers_;
  std::vector<uint32_t> queries_;            // Features in the order in which they are searched.
  std::vector<uint32_t> place_in_tile_;      // [features]: Rank by response within its tile.
  std::vector<uint32_t> counts_;             // [tiles]: Number of features.
  std::vector<std::optional<Match>> found_;  // [features]
  std::vector<Match> matches_;               // Most distinctive match first.
  size_t lookalikes_ = 0;                    // Number of features that only tell a look-alike.
  std::vector<uint32_t> match_of_point_;     // [points]: Index into matches_, or kNoMatch.
  std::vector<FeatureMatch> guided_matches_;
  std::vector<PoseMatch> pose_matches_;
  geometry::PreemptiveRansac<Eigen::Matrix<double, 3, 4>> ransac_;
  PoseRefiner refiner_;
  RefinedPose refined_;
  geometry::PreemptiveRansac<SeenPose> camera_ransac_;
  CameraRefiner camera_refiner_;
  RefinedCamera refined_camera_;
  PosedCamera posed_;
  const std::vector<uint32_t>* inliers_ = nullptr;  // Indices into pose_matches_.
  double noise_px_ = 0.0;                           // See RefinedPose.
  std::vector<LocatedPoint> points_;
  std::vector<double> depths_;
  std::vector<uint32_t> spots_;  // [inliers]: Key of the image cell that holds the inlier.
};

}  // namespace lararium::vision
