#include "shared/vision/patch_tracker.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "shared/core/check.h"

namespace lararium::vision {
namespace {

using geometry::CameraModel;
using geometry::Rigid3;

// The conditions for a reliable pose.
constexpr int kLeastAgreeing = 20;
constexpr double kLeastShare = 0.15;  // Share of the expected patches that agree.
constexpr int kLeastCells = 6;  // Cells with agreeing patches, out of kSpreadColumns x kSpreadRows.
constexpr int kSpreadColumns = 6;
constexpr int kSpreadRows = 5;
constexpr double kLargestTrackedErrorPx = 3.0;

constexpr double kSharedErrors = 2.0;    // Factor on the covariance of independent errors.
constexpr double kNoiseInflation = 2.0;  // Factor on the variance; pixel noise is correlated.
constexpr double kModelErrorPx = 0.03;   // Error of warp and interpolation, pixels of the level.
constexpr double kLeastPoseScale = 0.4;

// Whether an estimated camera can be the one that was expected, and is a camera at all. Patches
// that contradict the expected lens drag its parameters away: the lens has changed.
bool IsPlausible(const CameraEstimate& expected, const CameraEstimate& found) {
  constexpr double kMostDeviations = 4.0;
  const int unknown = expected.Unknown();
  const CameraVector off = Difference(expected, found);
  for (int i = kShutterParameters; i < unknown; ++i) {
    if (off[i] * off[i] > kMostDeviations * kMostDeviations * expected.covariance(i, i)) {
      return false;
    }
  }
  return expected.LensKnown() || found.model.Validate().ok();
}

int Coarsest(const ImagePyramid& image) {
  return std::min(image.levels() - 1, CoarsestLevel(image.level(0).cols));
}

}  // namespace

PatchTracker::PatchTracker(std::shared_ptr<const TrackedMap> map) : pool_(std::move(map)) {
  for (Fit* fit : {&fit_, &searched_}) {
    fit->observations.reserve(PatchPool::kMostPatches);
    fit->matches.reserve(PatchPool::kMostPatches);
    fit->pose.squares.reserve(PatchPool::kMostPatches);
    fit->pose.in_camera.reserve(PatchPool::kMostPatches);
  }
  agreeing_.reserve(PatchPool::kMostPatches);
  seen_.reserve(PatchPool::kMostPatches);
  depths_.reserve(PatchPool::kMostPatches);
}

void PatchTracker::Start(const CameraModel& camera, const Rigid3& camera_from_map) {
  exposure_.Forget();
  pool_.Start(camera, camera_from_map);
}

FollowedPose PatchTracker::Follow(const ImagePyramid& image,
                                  const CameraEstimate& camera,
                                  std::span<const Rigid3> predictions,
                                  const Rigid3* before,
                                  double frames) {
  FollowedPose result;
  exposure_.BeginImage(before, frames);
  pool_.BeginImage(predictions[0].Center());
  PosedCamera posed{BestPrediction(image, camera, predictions), camera};
  const int coarsest = Coarsest(image);
  int finest = 0;
  for (int level = coarsest; level >= finest; --level) {
    exposure_.SetPose(posed.camera_from_map);
    finest = std::min(FinestLevel(Exposed(posed)), level);
    const CameraPrior prior = PriorOf(camera);
    const int wanted = level == finest ? 1000 : level == coarsest ? 60 : 100;
    const int stride = std::max(1, static_cast<int>(pool_.size()) / wanted);
    PosedCamera moved = posed;
    bool found = RunLevel(image, prior, level, stride, moved, result.expected);
    if (level == coarsest && (!found || 3 * fit_.pose.inliers < result.expected)) {
      PosedCamera searched = posed;
      if (SearchLevel(image, prior, level, stride, found ? fit_.pose.inliers : 0, searched)) {
        moved = searched;
        found = true;
      }
    }
    if (found) {
      posed = moved;
    } else if (level == finest) {
      return result;
    }
  }
  result.camera_from_map = posed.camera_from_map;
  result.evidence.covariance = Covariance();
  result.agreeing = fit_.pose.inliers;
  if (exposure_.motion() == nullptr && result.agreeing > 0) {
    // Blur by an unknown motion shows as patches that are not found. Its effect on the other
    // patches is a common error, so the covariance grows.
    result.evidence.covariance.topLeftCorner<6, 6>() /= result.share() * result.share();
  }
  result.camera = posed.camera;
  result.camera.covariance =
      result.evidence.covariance.bottomRightCorner<kCameraParameters, kCameraParameters>();
  if (exposure_.motion() != nullptr) {
    result.motion = exposure_.motion()->during_frame;
    result.motion->head<3>() += posed.camera.turning;
    result.evidence.shutter = {posed.camera.readout, *result.motion};
    result.evidence.turning_change = exposure_.UnpredictedTurning();
  }
  Judge(camera, result);
  if (result.reliable) {
    LearnShutter(image, Exposed(posed), finest);
    result.blur_px = BlurPx(Exposed(posed));
    Settle(posed);
  }
  return result;
}

CameraPrior PatchTracker::PriorOf(const CameraEstimate& camera) const {
  CameraPrior prior{camera, nullptr, kSharedErrors};
  if (exposure_.motion() != nullptr) {
    prior.motion = &exposure_.motion()->during_frame;
    // The rows of a global shutter tell nothing.
    constexpr double kDeviations = 6.0;  // Patches share errors.
    constexpr double kLeastReadout = 0.05;
    const auto significant = [&](int parameter, double readout) {
      return std::abs(readout) > kLeastReadout &&
             readout * readout >
                 kDeviations * kDeviations * camera.covariance(parameter, parameter);
    };
    const bool rolls =
        significant(kReadoutX, camera.readout.x()) || significant(kReadoutY, camera.readout.y());
    if (rolls) {
      prior.camera.covariance.block<3, 3>(kTurnX, kTurnX) = exposure_.UnpredictedTurning();
    }
  }
  return prior;
}

CameraEstimate PatchTracker::EstimateCamera(const CameraEstimate& prior) {
  const PosedCamera start{fit_.pose.posed.camera_from_map, prior};
  if (!EstimatePatchPose(fit_.matches, PriorOf(prior), start, kLeastPoseScale, searched_.pose)) {
    return prior;
  }
  CameraEstimate camera = searched_.pose.posed.camera;
  camera.covariance =
      searched_.pose.covariance.bottomRightCorner<kCameraParameters, kCameraParameters>();
  return camera;
}

void PatchTracker::Judge(const CameraEstimate& prior, FollowedPose& pose) {
  const CameraModel& camera = pose.camera.model;
  CHECK(fit_.observations.size() == fit_.pose.squares.size());
  std::array<bool, kSpreadColumns * kSpreadRows> covered{};
  int cells = 0;
  depths_.clear();
  for (size_t i = 0; i < fit_.observations.size(); ++i) {
    if (!fit_.Agrees(i)) {
      continue;
    }
    const Eigen::Vector2d pixel = fit_.observations[i].pixel.cast<double>();
    bool& cell = covered[static_cast<size_t>(CellIn(camera, pixel, kSpreadColumns, kSpreadRows))];
    cells += cell ? 0 : 1;
    cell = true;
    depths_.push_back((pose.camera_from_map * fit_.matches[i].point).z());
  }
  if (depths_.empty()) {
    return;
  }
  std::sort(depths_.begin(), depths_.end());
  for (size_t i = 0; i < pose.evidence.depths.size(); ++i) {
    pose.evidence.depths[i] = depths_[(2 * i + 1) * depths_.size() / 6];
  }
  pose.evidence.inliers = pose.agreeing;
  const double variance = ComputeRegistrationVariance(camera, pose.evidence).sum;
  pose.expected_error_px = std::sqrt(variance);
  pose.reliable = pose.agreeing >= kLeastAgreeing && pose.share() >= kLeastShare &&
                  cells >= kLeastCells && pose.expected_error_px < kLargestTrackedErrorPx &&
                  IsPlausible(prior, pose.camera);
}

// Updates the motion statistics and the set of patches.
void PatchTracker::Settle(const PosedCamera& posed) {
  exposure_.EndImage(posed.camera_from_map);
  agreeing_.clear();
  seen_.clear();
  for (size_t i = 0; i < fit_.observations.size(); ++i) {
    if (fit_.Agrees(i)) {
      const PatchObservation& observation = fit_.observations[i];
      agreeing_.push_back(observation.patch);
      seen_.push_back({pool_[observation.patch].point, observation.pixel});
    }
  }
  pool_.EndImage(Exposed(posed), agreeing_);
}

// --- Finding the pose

void PatchTracker::Fit::Clear() {
  observations.clear();
  matches.clear();
}

void PatchTracker::AddObservation(uint32_t patch,
                                  int level,
                                  const PatchFit& found,
                                  Fit& fit) const {
  fit.observations.push_back({patch, PixelFromLevel(found.centre, level)});
  const double size = 1 << level;
  const Eigen::Vector2d pixel = PixelFromLevel(Eigen::Vector2d(found.centre.cast<double>()), level);
  const Eigen::Matrix2d information =
      found.information.cast<double>() / (kNoiseInflation * size * size);
  // The inverse of (information^-1 + error^2 I), in a form that also works if information is
  // singular, as it is at an edge.
  const double error2 =
      std::pow(kModelErrorPx * size, 2) + std::pow(static_cast<double>(pool_[patch].sigma_px), 2);
  const Eigen::Matrix2d softened =
      information * (Eigen::Matrix2d::Identity() + error2 * information).inverse();
  Eigen::Matrix2d symmetric = 0.5 * (softened + softened.transpose());
  symmetric.diagonal().array() += 1e-9;
  PatchMatch& match = fit.matches.emplace_back();
  match.point = pool_[patch].point_in_map;
  match.pixel = pixel;
  match.whitening = symmetric.llt().matrixU();
}

bool PatchTracker::RunLevel(const ImagePyramid& image,
                            const CameraPrior& prior,
                            int level,
                            int stride,
                            PosedCamera& posed,
                            int& expected) {
  fit_.Clear();
  expected = 0;
  const ExposedCamera exposed = Exposed(posed);
  PatchTemplate patch;
  const bool last = stride == 1;
  const PatchSearch search{
      .iterations = 10, .largest_shift = last ? 2.0f : 3.5f, .converged = last ? 0.01f : 0.05f};
  for (auto i = static_cast<uint32_t>(pool_.image() % static_cast<uint32_t>(stride));
       i < pool_.size(); i += static_cast<uint32_t>(stride)) {
    PatchView view;
    PatchFit fit;
    if (!pool_.Sample(exposed, i, level, view, patch)) {
      continue;
    }
    ++expected;
    const Eigen::Vector2f start = LevelFromPixel(view.pixel, level).cast<float>();
    if (!AlignPatch(image.level(level), patch, start, search, fit) ||
        fit.correlation < kLeastCorrelation) {
      continue;
    }
    AddObservation(i, level, fit, fit_);
  }
  if (!EstimatePatchPose(fit_.matches, prior, posed, kLeastPoseScale, fit_.pose)) {
    return false;
  }
  posed = fit_.pose.posed;
  return true;
}

bool PatchTracker::SearchLevel(const ImagePyramid& image,
                               const CameraPrior& prior,
                               int level,
                               int stride,
                               int least,
                               PosedCamera& posed) {
  constexpr int kReach = 5;
  searched_.Clear();
  const ExposedCamera exposed = Exposed(posed);
  PatchTemplate patch;
  for (auto i = uint32_t{0}; i < pool_.size(); i += static_cast<uint32_t>(stride)) {
    PatchView view;
    if (!pool_.Sample(exposed, i, level, view, patch)) {
      continue;
    }
    const Eigen::Vector2f centre = LevelFromPixel(view.pixel, level).cast<float>();
    float highest = kLeastCorrelation;
    Eigen::Vector2f best = centre;
    for (int dy = -kReach; dy <= kReach; ++dy) {
      for (int dx = -kReach; dx <= kReach; ++dx) {
        const Eigen::Vector2f place = centre + Eigen::Vector2f(dx, dy);
        const float correlation = CorrelatePatch(image.level(level), patch, place);
        if (correlation > highest) {
          highest = correlation;
          best = place;
        }
      }
    }
    PatchFit fit;
    if (highest > kLeastCorrelation &&
        AlignPatch(image.level(level), patch, best, {.largest_shift = 1.5f}, fit)) {
      AddObservation(i, level, fit, searched_);
    }
  }
  if (!EstimatePatchPose(searched_.matches, prior, posed, kLeastPoseScale, searched_.pose) ||
      searched_.pose.inliers <= least) {
    return false;
  }
  std::swap(fit_, searched_);
  posed = fit_.pose.posed;
  return true;
}

// The prediction with the highest correlation of the patches on the coarsest level.
Rigid3 PatchTracker::BestPrediction(const ImagePyramid& image,
                                    const CameraEstimate& camera,
                                    std::span<const Rigid3> predictions) {
  if (predictions.size() == 1) {
    return predictions[0];
  }
  const int level = Coarsest(image);
  constexpr uint32_t kSample = 40;
  const auto stride = std::max(uint32_t{1}, static_cast<uint32_t>(pool_.size()) / kSample);
  size_t best = 0;
  float highest = -1.0f;
  for (size_t candidate = 0; candidate < predictions.size(); ++candidate) {
    float sum = 0.0f;
    exposure_.SetPose(predictions[candidate]);
    const PosedCamera posed{predictions[candidate], camera};
    const ExposedCamera exposed = Exposed(posed);
    for (uint32_t i = 0; i < pool_.size(); i += stride) {
      PatchView view;
      PatchTemplate patch;
      if (pool_.Sample(exposed, i, level, view, patch)) {
        sum += std::max(0.0f, CorrelatePatch(image.level(level), patch,
                                             LevelFromPixel(view.pixel, level).cast<float>()));
      }
    }
    if (sum > highest) {
      highest = sum;
      best = candidate;
    }
  }
  return predictions[best];
}

// --- The exposure

// Mean length, in pixels, of the patches' paths in the image during the exposure.
double PatchTracker::BlurPx(const ExposedCamera& camera) const {
  constexpr size_t kSample = 20;
  if (camera.motion == nullptr) {
    return 0.0;
  }
  double sum = 0.0;
  int count = 0;
  const size_t stride = std::max(size_t{1}, pool_.size() / kSample);
  for (size_t i = 0; i < pool_.size(); i += stride) {
    PatchView view;
    if (pool_.View(camera, i, view)) {
      sum += view.velocity.norm();
      ++count;
    }
  }
  return sum / std::max(count, 1);
}

// Sum of the correlations of the agreeing patches, at their found positions, if they are blurred
// for the camera's shutter time.
double PatchTracker::Likeness(const ImagePyramid& image,
                              const ExposedCamera& camera,
                              int level) const {
  constexpr size_t kSample = 40;
  double sum = 0.0;
  const size_t stride = std::max(size_t{1}, fit_.observations.size() / kSample);
  for (size_t i = 0; i < fit_.observations.size(); i += stride) {
    PatchView view;
    PatchTemplate sampled;
    const PatchObservation& observation = fit_.observations[i];
    if (fit_.Agrees(i) && pool_.Sample(camera, observation.patch, level, view, sampled)) {
      sum += CorrelatePatch(image.level(level), sampled, LevelFromPixel(observation.pixel, level));
    }
  }
  return sum;
}

// Learns the shutter time from the blur of fast motion.
void PatchTracker::LearnShutter(const ImagePyramid& image, const ExposedCamera& camera, int level) {
  constexpr double kLeastShownPx = 3.0;  // Minimum motion per frame, pixels of the level.
  if (camera.motion == nullptr ||
      BlurPx(camera) / camera.motion->shutter / (1 << level) < kLeastShownPx) {
    return;
  }
  const auto likeness = [&](double change) {
    ExposureMotion tried = *camera.motion;
    tried.shutter += change;
    return Likeness(image, {camera.model, camera.camera_from_map, &tried, camera.readout}, level);
  };
  const double less = likeness(-ExposureModel::kShutterStep);
  const double same = likeness(0.0);
  const double more = likeness(ExposureModel::kShutterStep);
  exposure_.LearnShutter(less, same, more);
}

// The finest level on which the blur leaves structure to align. On finer levels only the ends of
// the blur path have contrast, and these depend on the speed there as much as on the position in
// the middle.
int PatchTracker::FinestLevel(const ExposedCamera& camera) const {
  constexpr double kMostBlurPx = 8.0;  // Pixels of the level.
  const double blur = BlurPx(camera);
  return blur > kMostBlurPx ? static_cast<int>(std::ceil(std::log2(blur / kMostBlurPx))) : 0;
}

// Covariance of the pose: that of patches with independent errors, enlarged for the errors that
// they share. These are the errors of the keyframes' poses and the part of the acceleration during
// the exposure that earlier images do not predict.
JointMatrix<kMostJoint> PatchTracker::Covariance() const {
  JointMatrix<kMostJoint> covariance = fit_.pose.covariance;
  if (exposure_.motion() != nullptr) {
    covariance.topLeftCorner<6, 6>() += exposure_.UnpredictedCovariance();
  }
  return covariance;
}

}  // namespace lararium::vision
