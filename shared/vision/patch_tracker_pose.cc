#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "shared/vision/patch_tracker.h"
#include "shared/vision/patch_tracker_parts.h"

namespace lararium::vision {
namespace {

using geometry::CameraModel;
using geometry::Rigid3;

constexpr double kNoiseInflation = 2.0;  // Factor on the variance; pixel noise is correlated.
constexpr double kModelErrorPx = 0.03;   // Error of warp and interpolation, pixels of the level.
constexpr double kLeastPoseScale = 0.4;

Rigid3 ExpMotion(const Vector6d& motion) {
  return {geometry::RotationFromVector(motion.head<3>()), motion.tail<3>()};
}

}  // namespace

// --- Projecting and sampling patches

bool PatchTracker::ViewSlot(const CameraModel& camera,
                            const Rigid3& camera_from_map,
                            const Slot& slot,
                            View& view) const {
  const Eigen::Vector3d p = camera_from_map * slot.point_in_map;
  if (slot.hidden || p.z() <= 1e-9) {
    return false;
  }
  const Eigen::Vector2d plane = p.hnormalized();
  if (camera.FoldsBackAt(plane)) {
    return false;
  }
  view.pixel = camera.PixelFromPlane(plane);
  if (!InsideBy(camera, view.pixel, kBorderPx)) {
    return false;
  }
  // The tangent plane induces the homography R + t n^T from the keyframe's plane z = 1 to that of
  // the camera.
  const Rigid3 camera_from_key = camera_from_map * PoseOf(slot).Inverse();
  const Eigen::Matrix3d homography = camera_from_key.rotation.toRotationMatrix() +
                                     camera_from_key.translation * slot.tangent.transpose();
  const double z = homography.row(2).dot(slot.key_plane.homogeneous());
  if (z <= 1e-9) {
    return false;
  }
  const Eigen::Matrix2d plane_slope =
      (homography.topLeftCorner<2, 2>() - plane * homography.bottomLeftCorner<1, 2>()) / z;
  const Eigen::Matrix2d pixel_from_key =
      PixelFromPlaneSlope(camera, plane) * plane_slope * slot.plane_from_key_pixel;
  // Rejects a patch that is seen from behind, edge-on, or much larger than in the keyframe.
  const double area = pixel_from_key.determinant();
  if (!(area > 0.05 && area < 8.0)) {
    return false;
  }
  view.key_from_pixel = pixel_from_key.inverse();
  view.velocity.setZero();
  view.acceleration.setZero();
  if (has_motion_) {
    const auto shift = [&](const Rigid3& motion) -> Eigen::Vector2d {
      const auto moved = camera.Project(motion * p);
      return moved ? Eigen::Vector2d(*moved - view.pixel) : Eigen::Vector2d::Zero();
    };
    view.velocity = shutter_ * shift(velocity_);
    view.acceleration = shutter_ * shutter_ * shift(acceleration_);
  }
  return true;
}

bool PatchTracker::SampleSlot(const Slot& slot,
                              const View& view,
                              int level,
                              PatchTemplate& patch) const {
  const ImagePyramid& pyramid = ImageOf(slot);
  // The keyframe's level whose pixels have about the same size.
  const double size = std::sqrt(view.key_from_pixel.determinant()) * (1 << level);
  const int key_level =
      std::clamp(static_cast<int>(std::lround(std::log2(size))), 0, pyramid.levels() - 1);
  const double shrink = 1.0 / (1 << key_level);
  PatchWarp warp;
  warp.centre = LevelFromPixel(slot.key_pixel, key_level).cast<float>();
  warp.source_from_patch = (shrink * (1 << level) * view.key_from_pixel).cast<float>();
  warp.motion.velocity = (shrink * view.key_from_pixel * view.velocity).cast<float>();
  warp.motion.acceleration = (shrink * view.key_from_pixel * view.acceleration).cast<float>();
  return patch.Sample(pyramid.level(key_level), warp);
}

// --- Finding the pose

void PatchTracker::Fit::Clear() {
  observations.clear();
  matches.clear();
}

void PatchTracker::AddObservation(
    const CameraModel& camera, uint32_t slot, int level, const PatchFit& patch, Fit& fit) const {
  fit.observations.push_back({slot, PixelFromLevel(patch.centre, level)});
  const double size = 1 << level;
  const Eigen::Vector2d pixel = PixelFromLevel(Eigen::Vector2d(patch.centre.cast<double>()), level);
  const Eigen::Matrix2d information =
      patch.information.cast<double>() / (kNoiseInflation * size * size);
  // The inverse of (information^-1 + error^2 I), in a form that also works if information is
  // singular, as it is at an edge.
  const double error2 =
      std::pow(kModelErrorPx * size, 2) + std::pow(static_cast<double>(slots_[slot].sigma_px), 2);
  const Eigen::Matrix2d softened =
      information * (Eigen::Matrix2d::Identity() + error2 * information).inverse();
  Eigen::Matrix2d symmetric = 0.5 * (softened + softened.transpose());
  symmetric.diagonal().array() += 1e-9;
  PatchMatch& match = fit.matches.emplace_back();
  match.point = slots_[slot].point_in_map;
  match.plane = camera.PlaneFromPixel(pixel);
  match.whitening = symmetric.llt().matrixU();
  match.whitening.col(0) *= camera.fx;
  match.whitening.col(1) *= camera.fy;
}

bool PatchTracker::RunLevel(const ImagePyramid& image,
                            const CameraModel& camera,
                            int level,
                            int stride,
                            Rigid3& camera_from_map,
                            int& expected) {
  fit_.Clear();
  expected = 0;
  PatchTemplate patch;
  const bool last = stride == 1;
  const PatchSearch search{
      .iterations = 10, .largest_shift = last ? 2.0f : 3.5f, .converged = last ? 0.01f : 0.05f};
  for (auto i = static_cast<uint32_t>(now_ % static_cast<uint32_t>(stride)); i < slots_.size();
       i += static_cast<uint32_t>(stride)) {
    View view;
    PatchFit fit;
    if (!ViewSlot(camera, camera_from_map, slots_[i], view) ||
        !SampleSlot(slots_[i], view, level, patch)) {
      continue;
    }
    ++expected;
    const Eigen::Vector2f start = LevelFromPixel(view.pixel, level).cast<float>();
    if (!AlignPatch(image.level(level), patch, start, search, fit) ||
        fit.correlation < kLeastCorrelation) {
      continue;
    }
    AddObservation(camera, i, level, fit, fit_);
  }
  if (!EstimatePatchPose(fit_.matches, camera_from_map, kLeastPoseScale, fit_.pose)) {
    return false;
  }
  camera_from_map = fit_.pose.camera_from_map;
  return true;
}

bool PatchTracker::SearchLevel(const ImagePyramid& image,
                               const CameraModel& camera,
                               int level,
                               int stride,
                               int least,
                               Rigid3& camera_from_map) {
  constexpr int kReach = 5;
  searched_.Clear();
  PatchTemplate patch;
  for (auto i = uint32_t{0}; i < slots_.size(); i += static_cast<uint32_t>(stride)) {
    View view;
    if (!ViewSlot(camera, camera_from_map, slots_[i], view) ||
        !SampleSlot(slots_[i], view, level, patch)) {
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
      AddObservation(camera, i, level, fit, searched_);
    }
  }
  if (!EstimatePatchPose(searched_.matches, camera_from_map, kLeastPoseScale, searched_.pose) ||
      searched_.pose.inliers <= least) {
    return false;
  }
  std::swap(fit_, searched_);
  camera_from_map = fit_.pose.camera_from_map;
  return true;
}

// The prediction with the highest correlation of the patches on the coarsest level.
Rigid3 PatchTracker::BestPrediction(const ImagePyramid& image,
                                    const CameraModel& camera,
                                    std::span<const Rigid3> predictions) {
  if (predictions.size() == 1) {
    return predictions[0];
  }
  const int level = Coarsest(image);
  constexpr uint32_t kSample = 40;
  const auto stride = std::max(uint32_t{1}, static_cast<uint32_t>(slots_.size()) / kSample);
  size_t best = 0;
  float highest = -1.0f;
  for (size_t candidate = 0; candidate < predictions.size(); ++candidate) {
    float sum = 0.0f;
    SetMotion(predictions[candidate]);
    for (uint32_t i = 0; i < slots_.size(); i += stride) {
      View view;
      PatchTemplate patch;
      if (ViewSlot(camera, predictions[candidate], slots_[i], view) &&
          SampleSlot(slots_[i], view, level, patch)) {
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

// Updates velocity and acceleration at this frame from the last two motions between frames.
void PatchTracker::SetMotion(const Rigid3& camera_from_map) {
  if (!has_motion_) {
    return;
  }
  const Rigid3 since = camera_from_map * before_.Inverse();
  motion_.head<3>() = geometry::VectorFromRotation(since.rotation) / frames_;
  motion_.tail<3>() = since.translation / frames_;
  // motion_ is the velocity half a frame ago; extrapolates it to the time of this frame.
  const Vector6d acceleration =
      has_motion_before_ ? Vector6d(motion_ - motion_before_) : Vector6d::Zero();
  velocity_ = ExpMotion(motion_ + 0.5 * acceleration);
  acceleration_ = ExpMotion(acceleration);
}

// Mean length, in pixels, of the patches' paths in the image during the exposure.
double PatchTracker::BlurPx(const CameraModel& camera, const Rigid3& camera_from_map) const {
  constexpr size_t kSample = 20;
  if (!has_motion_) {
    return 0.0;
  }
  double sum = 0.0;
  int count = 0;
  const size_t stride = std::max(size_t{1}, slots_.size() / kSample);
  for (size_t i = 0; i < slots_.size(); i += stride) {
    View view;
    if (ViewSlot(camera, camera_from_map, slots_[i], view)) {
      sum += view.velocity.norm();
      ++count;
    }
  }
  return sum / std::max(count, 1);
}

// Sum of the correlations of the agreeing patches, at their found positions, if they are blurred
// for this shutter time.
double PatchTracker::Likeness(const ImagePyramid& image,
                              const CameraModel& camera,
                              int level,
                              const Rigid3& camera_from_map,
                              double shutter) {
  constexpr size_t kSample = 40;
  const double kept = std::exchange(shutter_, shutter);
  double sum = 0.0;
  const size_t stride = std::max(size_t{1}, fit_.observations.size() / kSample);
  for (size_t i = 0; i < fit_.observations.size(); i += stride) {
    View view;
    PatchTemplate patch;
    if (fit_.pose.squares[i] < kInlierSquare &&
        ViewSlot(camera, camera_from_map, slots_[fit_.observations[i].slot], view) &&
        SampleSlot(slots_[fit_.observations[i].slot], view, level, patch)) {
      sum += CorrelatePatch(image.level(level), patch,
                            LevelFromPixel(fit_.observations[i].pixel, level));
    }
  }
  shutter_ = kept;
  return sum;
}

// Estimates the shutter time from the blur of fast motion: moves towards the maximum of a parabola
// through the correlations at three shutter times.
void PatchTracker::EstimateShutter(const ImagePyramid& image,
                                   const CameraModel& camera,
                                   int level,
                                   const Rigid3& camera_from_map) {
  constexpr double kTrial = 0.15;
  constexpr double kLeastShare = 0.25;   // Share of the step that is applied after many trials.
  constexpr double kLeastShownPx = 3.0;  // Minimum motion per frame, pixels of the level.
  const double shown = BlurPx(camera, camera_from_map) / shutter_ / (1 << level);
  if (shown < kLeastShownPx) {
    return;
  }
  const double less = Likeness(image, camera, level, camera_from_map, shutter_ - kTrial);
  const double same = Likeness(image, camera, level, camera_from_map, shutter_);
  const double more = Likeness(image, camera, level, camera_from_map, shutter_ + kTrial);
  const double bend = 2.0 * same - less - more;
  const double rise = more - less;
  const double step =
      bend > 0.0 ? std::clamp(0.5 * rise / bend, -1.0, 1.0) : (rise > 0.0 ? 1.0 : -1.0);
  const double share = std::max(kLeastShare, 1.0 / ++shutter_trials_);
  shutter_ = std::clamp(shutter_ + share * kTrial * step, kTrial, 1.0);
}

// The finest level on which the blur leaves structure to align. On finer levels only the ends of
// the blur path have contrast, and these depend on the speed there as much as on the position in
// the middle.
int PatchTracker::FinestLevel(const CameraModel& camera, const Rigid3& camera_from_map) const {
  constexpr double kMostBlurPx = 8.0;  // Pixels of the level.
  const double blur = BlurPx(camera, camera_from_map);
  return blur > kMostBlurPx ? static_cast<int>(std::ceil(std::log2(blur / kMostBlurPx))) : 0;
}

// Mean square of the recent acceleration. Before any was measured, the motion may have just begun,
// so the acceleration may be as large as the motion.
Matrix6d PatchTracker::Accelerations() const {
  return knows_accelerations_ ? accelerations_ : Matrix6d(motion_ * motion_.transpose());
}

// Covariance of the pose: that of patches with independent errors, enlarged for the errors that
// they share. These are the errors of the keyframes' poses and the part of the acceleration during
// the exposure that earlier frames do not predict.
Matrix6d PatchTracker::Covariance() const {
  constexpr double kSharedErrors = 2.0;
  Matrix6d covariance = kSharedErrors * fit_.pose.covariance;
  if (has_motion_) {
    // Displacement by an unpredicted acceleration a, as a share of shutter^2 a.
    constexpr double kUnforeseen = 1.0 / 16.0;
    const double share = kUnforeseen * shutter_ * shutter_;
    const Matrix6d accelerations = Accelerations();
    Matrix6d doubt = accelerations;
    doubt.diagonal().head<3>().array() += accelerations.diagonal().head<3>().mean();
    doubt.diagonal().tail<3>().array() += accelerations.diagonal().tail<3>().mean();
    covariance += share * share * doubt;
  }
  return covariance;
}

}  // namespace lararium::vision
