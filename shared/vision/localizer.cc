#include "shared/vision/localizer.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

#include "shared/core/parallel.h"
#include "shared/geometry/p3p.h"
#include "shared/geometry/radial_pose.h"

namespace lararium::vision {
namespace {

using geometry::CameraModel;
using geometry::Rigid3;

constexpr size_t kNeighbours = 8;      // Per query; usually more than one point's descriptors.
constexpr size_t kSearchJobs = 8;      // Parallel jobs, each with its own searcher.
constexpr size_t kLeastMatches = 6;    // Below this number, agreement proves nothing.
constexpr size_t kFirstQueries = 400;  // Number of features that are searched first.
constexpr int kPlentyOfInliers = 50;   // Enough inliers to skip the search for the other features.
constexpr double kGuidedRadiusPx = 3.0;
constexpr double kPredictedRadiusPx = 16.0;
constexpr size_t kManyLookalikes = 30;           // Fewer features say nothing of the place.
constexpr uint32_t kSameAppearance = 180 * 180;  // Squared distance of descriptors.
constexpr size_t kSample = 3;                    // Number of matches that determine a pose.
constexpr size_t kCameraSample = 5;        // The same with an unknown focal length and distortion.
constexpr double kPosesOfSample = 4.0;     // Maximum number of solutions of a sample.
constexpr double kMostFalseAlarms = 1e-6;  // Expected number of accidental poses per image.
constexpr float kSpotPx = 8.0f;            // Matches in one cell of this size count once.
constexpr double kLargestErrorPx = 5.0;    // Largest expected error of an accepted pose.

// Relative uncertainty of a matched position. Measured on sequences with ground truth: it grows
// with the scale of the feature and with the distance of the descriptors. The point itself is known
// better the more often training observed it.
double SigmaOf(const Keypoint& keypoint, uint32_t squared_distance, uint32_t observations) {
  constexpr double kScale = 3.0;  // pixels
  constexpr double kDistance = 18000.0;
  constexpr double kObservations = 10.0;
  const double s = keypoint.scale / kScale;
  const double d = 1.0 + squared_distance / kDistance;
  return std::sqrt((1.0 + s * s) * d * d + kObservations / std::max(observations, 1u));
}

// The factor by which the covariance of a pose from `inliers` matches is too small if the matches
// are taken as independent. Errors that matches share (an uneven hand movement during the exposure,
// a bend in the map) do not show in the residuals and do not average out. Matches with intra-class
// correlation rho carry no more information than 1 / rho independent ones (the design effect; Kish,
// "Survey Sampling", 1965). rho grows steeply with the noise, because the errors in the sharpest
// images are hardly more than independent pixel noise. Exponent and factor were fitted to the
// normalised pose errors of five sequences. In leave-one-out validation they predict the mean error
// of the remaining sequence to a factor of about 2.
double DesignEffect(double noise_px, int inliers) {
  constexpr double kFactor = 18.0;  // pixels^-4
  const double rho = std::min(kFactor * std::pow(noise_px, 4), 1.0);
  return 1.0 + rho * inliers;
}

// Divides the image into square tiles; the grid extends to the outermost features.
class TileGrid {
 public:
  explicit TileGrid(const Features& features) {
    for (const Keypoint& keypoint : features.keypoints) {
      columns_ = std::max(columns_, Index(keypoint.x) + 1);
      rows_ = std::max(rows_, Index(keypoint.y) + 1);
    }
  }
  size_t size() const { return columns_ * rows_; }
  size_t TileOf(const Keypoint& keypoint) const {
    return Index(keypoint.y) * columns_ + Index(keypoint.x);
  }
  static double TileArea() { return kTilePx * kTilePx; }

 private:
  static constexpr float kTilePx = 64.0f;
  static size_t Index(float pixels) {
    return static_cast<size_t>(std::max(pixels, 0.0f) / kTilePx);
  }
  size_t columns_ = 0;
  size_t rows_ = 0;
};

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

Location Localizer::Locate(const Features& features, const CameraGuess& guess) {
  const CameraModel& camera = guess.prior.model;
  Location location;
  location.camera = guess.prior;
  points_.clear();
  location.reason = TrackReason::kTooFewFeatures;
  if (features.size() < static_cast<size_t>(options_.min_inliers)) {
    return location;
  }
  planes_.resize(features.size());
  for (size_t i = 0; i < features.size(); ++i) {
    planes_[i] = camera.PlaneFromPixel({features.keypoints[i].x, features.keypoints[i].y});
  }
  // A few hundred strong features, spread over the image, nearly always determine the pose. The
  // other features then need no search without a prior.
  OrderQueries(features);
  found_.assign(features.size(), std::nullopt);
  const size_t first = std::min(kFirstQueries, queries_.size());
  SearchMatches(features, 0, first);
  bool located = LocateFromMatches(features, guess, location);
  if (first < queries_.size() && (!located || location.inliers < kPlentyOfInliers)) {
    SearchMatches(features, first, queries_.size());
    Location full;
    full.camera = guess.prior;
    located = LocateFromMatches(features, guess, full);
    if (located || !location.camera_from_map) {
      location = full;
    }
  }
  if (!location.camera_from_map && location.reason == TrackReason::kAmbiguous && guess.predicted) {
    LocateAtPrediction(features, guess, location);
  }
  return location;
}

bool Localizer::LocateAtPrediction(const Features& features,
                                   const CameraGuess& guess,
                                   Location& location) {
  posed_ = {*guess.predicted, guess.prior};
  for (const double radius : {kPredictedRadiusPx, kGuidedRadiusPx}) {
    guided_.Match(posed_.camera.model, posed_.camera_from_map, features, radius, guided_matches_);
    FillPoseMatches(features, guided_matches_);
    Refine(guess);
    if (static_cast<int>(inliers_->size()) < kPlentyOfInliers ||
        !posed_.camera.model.Validate().ok()) {
      return false;
    }
  }
  if (!Judge(guess, location)) {
    return false;
  }
  FillPoints(features);
  return true;
}

bool Localizer::LocateFromMatches(const Features& features,
                                  const CameraGuess& guess,
                                  Location& location) {
  location.matches = static_cast<int>(matches_.size());
  location.reason = IsAmbiguous() ? TrackReason::kAmbiguous : TrackReason::kTooFewMatches;
  if (matches_.size() < kLeastMatches) {
    return false;
  }
  location.reason = IsAmbiguous() ? TrackReason::kAmbiguous : TrackReason::kNoConsistentPose;
  FillPoseMatches(features, matches_);
  if (guess.prior.LensKnown()) {
    const std::optional<Rigid3> first = FindPose(guess.prior.model);
    if (!first) {
      return false;
    }
    posed_ = {*first, guess.prior};
  } else {
    const std::optional<PosedCamera> first = FindPosedCamera(guess);
    if (!first) {
      return false;
    }
    posed_ = *first;
  }
  Refine(guess);
  if (inliers_->size() < kLeastMatches || !posed_.camera.model.Validate().ok() ||
      !IsNoAccident(features, guess)) {
    return false;
  }
  guided_.Match(posed_.camera.model, posed_.camera_from_map, features, kGuidedRadiusPx,
                guided_matches_);
  if (!ShowsUniquePoints()) {
    location.reason = TrackReason::kAmbiguous;
    return false;
  }
  FillPoseMatches(features, guided_matches_);
  Refine(guess);
  if (!posed_.camera.model.Validate().ok() || !Judge(guess, location)) {
    return false;
  }
  FillPoints(features);
  return true;
}

void Localizer::Refine(const CameraGuess& guess) {
  if (guess.prior.LensKnown()) {
    refiner_.Refine(pose_matches_, {guess.prior.model.Focal(), options_.inlier_threshold_px},
                    posed_.camera_from_map, refined_);
    posed_.camera_from_map = refined_.camera_from_map;
    inliers_ = &refined_.inliers;
    noise_px_ = refined_.noise_px;
  } else {
    camera_refiner_.Refine(pose_matches_, options_.inlier_threshold_px, posed_, guess.prior,
                           refined_camera_);
    posed_ = refined_camera_.posed;
    inliers_ = &refined_camera_.inliers;
    noise_px_ = refined_camera_.noise_px;
  }
}

// The covariance of the pose and the camera, errors that matches share included.
JointMatrix<kMostJoint> Localizer::Covariance(const CameraGuess& guess) const {
  const double effect = DesignEffect(noise_px_, static_cast<int>(inliers_->size()));
  if (guess.prior.LensKnown()) {
    return WithKnownCamera(effect * refined_.covariance);
  }
  JointMatrix<kMostJoint> information =
      refined_camera_.information / (effect * noise_px_ * noise_px_);
  information.bottomRightCorner<kCameraParameters, kCameraParameters>() += Information(guess.prior);
  return BoundedMatrix(information).inverse();
}

// Orders the features by their rank within their tile: first the strongest feature of every tile,
// then the second of every tile, and so on.
void Localizer::OrderQueries(const Features& features) {
  queries_.resize(features.size());
  std::iota(queries_.begin(), queries_.end(), 0u);
  const auto& keypoints = features.keypoints;
  std::sort(queries_.begin(), queries_.end(), [&](uint32_t a, uint32_t b) {
    return keypoints[a].response != keypoints[b].response
               ? keypoints[a].response > keypoints[b].response
               : a < b;
  });
  const TileGrid grid(features);
  counts_.assign(grid.size(), 0);
  place_in_tile_.resize(features.size());
  for (const uint32_t f : queries_) {
    place_in_tile_[f] = counts_[grid.TileOf(keypoints[f])]++;
  }
  std::stable_sort(queries_.begin(), queries_.end(),
                   [&](uint32_t a, uint32_t b) { return place_in_tile_[a] < place_in_tile_[b]; });
}

// Returns whether it is improbable that this many matches agree by chance. Compares the expected
// number of poses that as many random matches would support with a threshold (Moisan & Stival, "A
// probabilistic criterion to detect rigid point matches between two images", IJCV 2004; Moulon,
// Monasse & Marlet, "Adaptive structure from motion with a contrario model estimation", ACCV 2012).
// A random match puts its point at a random feature of the image, so accidental agreement is more
// probable where features are dense. Matches at the same spot count once.
bool Localizer::IsNoAccident(const Features& features, const CameraGuess& guess) {
  const CameraModel& camera = guess.prior.model;
  const double sample = guess.prior.LensKnown() ? kSample : kCameraSample;
  // The largest residual that an uncertain inlier may have; see SelectInliers.
  const double radius = 2.0 * options_.inlier_threshold_px;
  const TileGrid grid(features);
  counts_.assign(grid.size(), 0);
  for (const Keypoint& keypoint : features.keypoints) {
    ++counts_[grid.TileOf(keypoint)];
  }
  spots_.clear();
  double log_chance = 0.0;
  for (const uint32_t i : *inliers_) {
    if (database_.HasLookalike(matches_[i].point)) {
      continue;
    }
    const Keypoint& keypoint = features.keypoints[matches_[i].feature];
    const auto column = static_cast<uint32_t>(std::max(keypoint.x, 0.0f) / kSpotPx);
    const auto row = static_cast<uint32_t>(std::max(keypoint.y, 0.0f) / kSpotPx);
    spots_.push_back(row << 16 | column);
    // Local density of features, but at least that of a uniform distribution.
    const double share = counts_[grid.TileOf(keypoint)] / static_cast<double>(features.size());
    const double density = std::max(share / grid.TileArea(),
                                    1.0 / (static_cast<double>(camera.width) * camera.height));
    log_chance += std::log(std::min(std::numbers::pi * radius * radius * density, 1.0));
  }
  const auto inliers = static_cast<double>(spots_.size());
  log_chance /= std::max(inliers, 1.0);
  std::sort(spots_.begin(), spots_.end());
  spots_.erase(std::unique(spots_.begin(), spots_.end()), spots_.end());
  const auto k = static_cast<double>(spots_.size());
  // Inliers that share a spot with another inlier are not counted as matches either.
  const auto distinct = std::count_if(matches_.begin(), matches_.end(), [&](const Match& match) {
    return !database_.HasLookalike(match.point);
  });
  const double n = static_cast<double>(distinct) - (inliers - k);
  if (k <= sample) {
    return false;
  }
  const auto log_choose = [](double from, double count) {
    return std::lgamma(from + 1.0) - std::lgamma(count + 1.0) - std::lgamma(from - count + 1.0);
  };
  const double log_tests =
      std::log(kPosesOfSample * (n - sample)) + log_choose(n, k) + log_choose(k, sample);
  return log_tests + (k - sample) * log_chance < std::log(kMostFalseAlarms);
}

bool Localizer::Judge(const CameraGuess& guess, Location& location) {
  location.inliers = static_cast<int>(inliers_->size());
  if (location.inliers < options_.min_inliers) {
    return false;
  }
  const CameraModel& camera = posed_.camera.model;
  const PoseEvidence evidence{
      .covariance = Covariance(guess), .depths = Depths(), .inliers = location.inliers};
  const double error = std::sqrt(ComputeRegistrationVariance(camera, evidence).sum);
  if (!(error < kLargestErrorPx)) {
    return false;
  }
  location.camera_from_map = posed_.camera_from_map;
  location.camera = posed_.camera;
  if (!guess.prior.LensKnown()) {
    location.camera.covariance =
        evidence.covariance.bottomRightCorner<kCameraParameters, kCameraParameters>();
  }
  location.covariance = evidence.covariance.topLeftCorner<6, 6>();
  location.reason = TrackReason::kNone;
  location.expected_error_px = error;
  location.confidence = static_cast<float>(PoseConfidence(camera, evidence));
  return true;
}

void Localizer::FillPoints(const Features& features) {
  points_.clear();
  for (const uint32_t i : *inliers_) {
    const FeatureMatch& match = guided_matches_[i];
    const Keypoint& keypoint = features.keypoints[match.feature];
    const double sigma = noise_px_ * SigmaOf(keypoint, match.squared_distance,
                                             database_.observation_counts[match.point]);
    points_.push_back({match.point, static_cast<float>(sigma), {keypoint.x, keypoint.y}});
  }
  std::sort(points_.begin(), points_.end(), [](const LocatedPoint& a, const LocatedPoint& b) {
    return a.sigma_px != b.sigma_px ? a.sigma_px < b.sigma_px : a.point < b.point;
  });
}

template <typename M>
void Localizer::FillPoseMatches(const Features& features, const std::vector<M>& matches) {
  pose_matches_.clear();
  for (const FeatureMatch& match : matches) {
    const Keypoint& keypoint = features.keypoints[match.feature];
    pose_matches_.push_back(
        {database_.points[match.point].cast<double>(), planes_[match.feature],
         SigmaOf(keypoint, match.squared_distance, database_.observation_counts[match.point]),
         Eigen::Vector2d(keypoint.x, keypoint.y)});
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
  // If all neighbours belong to the same point, the distance of the last one is a lower bound for
  // that of any other point.
  uint32_t other = neighbours[count - 1].squared_distance;
  for (size_t i = 1; i < count; ++i) {
    if (database_.descriptor_point[neighbours[i].descriptor] != point) {
      other = neighbours[i].squared_distance;
      break;
    }
  }
  const float ratio =
      static_cast<float>(neighbours[0].squared_distance) / static_cast<float>(std::max(other, 1u));
  // A feature whose point has look-alikes is not distinctive, but says that the place is in view.
  if (ratio >= options_.ratio * options_.ratio &&
      !(database_.HasLookalike(point) && neighbours[0].squared_distance < kSameAppearance)) {
    return std::nullopt;
  }
  return Match{{feature, point, neighbours[0].squared_distance}, ratio};
}

void Localizer::SearchMatches(const Features& features, size_t begin, size_t end) {
  ParallelFor(kSearchJobs, [&](size_t job) {
    const size_t last = begin + (end - begin) * (job + 1) / kSearchJobs;
    for (size_t q = begin + (end - begin) * job / kSearchJobs; q < last; ++q) {
      const uint32_t feature = queries_[q];
      found_[feature] = SearchMatch(features, feature, searchers_[job]);
    }
  });
  KeepMatches();
  std::sort(matches_.begin(), matches_.end(), [](const Match& a, const Match& b) {
    return a.ratio != b.ratio ? a.ratio < b.ratio : a.feature < b.feature;
  });
}

// Keeps the distinctive matches, the best of each point, and counts the others.
void Localizer::KeepMatches() {
  matches_.clear();
  lookalikes_ = 0;
  for (const std::optional<Match>& match : found_) {
    if (!match) {
      continue;
    }
    if (match->ratio >= options_.ratio * options_.ratio) {
      ++lookalikes_;
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

// The first samples are drawn from the most distinctive matches, later ones from a growing pool
// (after Chum & Matas, "Matching with PROSAC", CVPR 2005).
template <size_t N>
std::array<const PoseMatch*, N> Localizer::DrawSample(uint32_t sample, Random& random) const {
  constexpr uint32_t kFirstPool = 12;
  const auto count = static_cast<uint32_t>(matches_.size());
  const uint32_t grown = kFirstPool + 4 * count * sample / (3 * options_.hypotheses);
  const uint32_t pool = std::min(grown, count);
  std::array<const PoseMatch*, N> drawn;
  for (const PoseMatch*& match : drawn) {
    match = &pose_matches_[random.Below(pool)];
  }
  return drawn;
}

std::optional<Rigid3> Localizer::FindPose(const CameraModel& camera) {
  using Pose = Eigen::Matrix<double, 3, 4>;
  uint32_t samples = 0;
  const auto generate = [&](Random& random, std::vector<Pose>& poses) {
    const auto drawn = DrawSample<kSample>(samples++, random);
    std::array<Eigen::Vector3d, 3> rays;
    std::array<Eigen::Vector3d, 3> points;
    for (size_t i = 0; i < kSample; ++i) {
      rays[i] = drawn[i]->plane.homogeneous().normalized();
      points[i] = drawn[i]->point;
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
  const auto winner = ransac_.Run(matches_.size(), ransac_options, generate, cost);
  if (!winner) {
    return std::nullopt;
  }
  const Pose& pose = *winner;
  return Rigid3::FromMatrix(pose.leftCols<3>(), pose.col(3));
}

// The pose of a camera of unknown focal length and distortion. Half of the samples suppose one of
// the candidates; the others, of five matches, suppose nothing.
std::optional<PosedCamera> Localizer::FindPosedCamera(const CameraGuess& guess) {
  const CameraModel& model = guess.prior.model;
  const Eigen::Vector2d middle(model.cx, model.cy);
  const double half_size = 0.5 * std::max(model.width, model.height);
  uint32_t samples = 0;
  const auto suppose = [&](const CameraModel& candidate, Random& random,
                           std::vector<SeenPose>& poses) {
    const auto drawn = DrawSample<kSample>(samples, random);
    std::array<Eigen::Vector3d, 3> rays;
    std::array<Eigen::Vector3d, 3> points;
    for (size_t i = 0; i < kSample; ++i) {
      rays[i] = candidate.PlaneFromPixel(drawn[i]->pixel).homogeneous().normalized();
      points[i] = drawn[i]->point;
    }
    const double focal = candidate.Focal();
    const geometry::P3pSolutions solutions = geometry::SolveP3p(rays, points);
    for (const Rigid3& pose : solutions.poses()) {
      poses.push_back({pose.Matrix3x4(), focal, candidate.k1 / (focal * focal)});
    }
  };
  const auto generate = [&](Random& random, std::vector<SeenPose>& poses) {
    const size_t pick = samples / 2;
    if (samples % 2 == 0 && !guess.candidates.empty()) {
      suppose(guess.candidates[pick % guess.candidates.size()], random, poses);
    } else {
      const auto drawn = DrawSample<kCameraSample>(samples, random);
      std::array<Eigen::Vector2d, kCameraSample> pixels;
      std::array<Eigen::Vector3d, kCameraSample> points;
      for (size_t i = 0; i < kCameraSample; ++i) {
        pixels[i] = drawn[i]->pixel - middle;
        points[i] = drawn[i]->point;
      }
      const geometry::RadialPoseSolutions solutions =
          geometry::SolveRadialPose(pixels, points, half_size);
      for (const geometry::RadialPose& found : solutions.all()) {
        poses.push_back({found.camera_from_world.Matrix3x4(), found.focal, found.division});
      }
    }
    ++samples;
  };
  const double limit = std::pow(2.0 * options_.inlier_threshold_px, 2);
  const auto cost = [&](const SeenPose& seen, uint32_t i) {
    const PoseMatch& match = pose_matches_[i];
    const Eigen::Vector3d p = seen.pose.leftCols<3>() * match.point + seen.pose.col(3);
    if (p.z() <= 0.0) {
      return limit;
    }
    const Eigen::Vector2d pixel = match.pixel - middle;
    const double stretch = 1.0 / (1.0 + seen.division * pixel.squaredNorm());
    const double square = (seen.focal * p.hnormalized() - stretch * pixel).squaredNorm();
    return std::min(square, limit);
  };
  const geometry::PreemptiveRansacOptions ransac_options{.hypotheses = 2 * options_.hypotheses,
                                                         .seed = options_.seed};
  const auto winner = camera_ransac_.Run(matches_.size(), ransac_options, generate, cost);
  if (!winner) {
    return std::nullopt;
  }
  PosedCamera posed{Rigid3::FromMatrix(winner->pose.leftCols<3>(), winner->pose.col(3)),
                    guess.prior};
  posed.camera.model.fx = posed.camera.model.fy = winner->focal;
  posed.camera.model.k1 = winner->division * winner->focal * winner->focal;
  posed.camera.model.k2 = posed.camera.model.p1 = posed.camera.model.p2 = 0.0;
  return posed;
}

bool Localizer::ShowsUniquePoints() const {
  constexpr double kLeastShare = 0.5;
  constexpr double kFew = 20.0;  // Shares of fewer points say nothing.
  const auto found = static_cast<double>(guided_matches_.size());
  const auto lookalikes = static_cast<double>(std::count_if(
      guided_matches_.begin(), guided_matches_.end(),
      [&](const FeatureMatch& match) { return database_.HasLookalike(match.point); }));
  const auto sought = static_cast<double>(guided_.searched(true));
  const auto unique = static_cast<double>(guided_.searched(false));
  return lookalikes < kFew || (found - lookalikes) * sought >= kLeastShare * lookalikes * unique;
}

bool Localizer::IsAmbiguous() const {
  size_t with = lookalikes_;
  for (const Match& match : matches_) {
    with += database_.HasLookalike(match.point) ? 1 : 0;
  }
  return with >= kManyLookalikes && with > matches_.size() + lookalikes_ - with;
}

// Quartiles of the inliers' depths.
std::array<double, 3> Localizer::Depths() {
  depths_.clear();
  for (const uint32_t i : *inliers_) {
    depths_.push_back((posed_.camera_from_map * pose_matches_[i].point).z());
  }
  std::sort(depths_.begin(), depths_.end());
  return {depths_[depths_.size() / 4], depths_[depths_.size() / 2],
          depths_[depths_.size() * 3 / 4]};
}

}  // namespace lararium::vision
