#include "shared/vision/follower.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "shared/core/check.h"

namespace lararium::vision {
namespace {

using geometry::CameraModel;
using geometry::Rigid3;

constexpr uint32_t kUsed = 0xffffffff;
constexpr double kBorderPx = 6.0;  // a patch's centre keeps from the image's border

// What makes a patch a match.
constexpr float kLeastCorrelation = 0.7f;
constexpr double kNoiseInflation = 2.0;  // variance: pixels' noise is not independent
constexpr double kModelErrorPx = 0.03;   // of warp and interpolation, on the level at hand
constexpr double kLeastScale = 0.4;

// What makes a pose honest.
constexpr int kLeastAgreeing = 20;
constexpr double kLeastShare = 0.15;
constexpr int kLeastCells = 6;  // of kSpreadColumns x kSpreadRows
constexpr int kSpreadColumns = 6;
constexpr int kSpreadRows = 5;
constexpr double kLargestErrorPx = 3.0;

constexpr int kMostFailures = 4;
constexpr uint32_t kRestFailed = 20;    // frames until a point may be chosen again
constexpr uint32_t kRestUseless = 300;  // one without a usable patch
// Models of occluders are as exact as their maker measured; thin things hide nothing.
constexpr double kHidingBias = 0.02;   // of the distance
constexpr uint32_t kHideInterval = 4;  // frames between looks whether one is behind an occluder
constexpr uint32_t kRestHidden = 15;   // one behind an occluder
constexpr size_t kTrials = 4;          // hidden points looked for in each frame
constexpr size_t kLeastLeft = 40;      // slots that believed occluders must leave
constexpr uint32_t kAimInterval = 8;   // frames between looks for a better keyframe

// A number of 0..1 that depends on both and looks random.
float Hash(uint32_t a, uint32_t b) {
  uint32_t h = a * 0x9e3779b1u ^ (b + 0x7f4a7c15u) * 0x85ebca6bu;
  h ^= h >> 15;
  h *= 0xc2b2ae35u;
  h ^= h >> 13;
  return static_cast<float>(h >> 8) * 0x1p-24f;
}

// Raw pixels from the plane z = 1, to first order.
Eigen::Matrix2d PixelFromPlaneSlope(const CameraModel& camera, const Eigen::Vector2d& plane) {
  Eigen::Matrix2d slope = Eigen::Vector2d(camera.fx, camera.fy).asDiagonal();
  if (camera.HasDistortion()) {
    constexpr double kStep = 1e-4;
    for (int i = 0; i < 2; ++i) {
      const Eigen::Vector2d step = kStep * Eigen::Vector2d::Unit(i);
      slope.col(i) = (camera.PixelFromPlane(plane + step) - camera.PixelFromPlane(plane - step)) /
                     (2.0 * kStep);
    }
  }
  return slope;
}

bool InsideBy(const CameraModel& camera, const Eigen::Vector2d& pixel, double border) {
  return pixel.x() >= border && pixel.y() >= border && pixel.x() <= camera.width - 1 - border &&
         pixel.y() <= camera.height - 1 - border;
}

Rigid3 ExpMotion(const Vector6d& motion) {
  return {geometry::RotationFromVector(motion.head<3>()), motion.tail<3>()};
}

int Coarsest(const ImagePyramid& image) {
  return std::min(image.levels() - 1, CoarsestLevel(image.level(0).cols));
}

int CellIn(const CameraModel& camera, const Eigen::Vector2d& pixel, int columns, int rows) {
  const int column =
      std::clamp(static_cast<int>(pixel.x() * columns / camera.width), 0, columns - 1);
  const int row = std::clamp(static_cast<int>(pixel.y() * rows / camera.height), 0, rows - 1);
  return row * columns + column;
}

}  // namespace

Follower::Follower(std::shared_ptr<const FollowMap> map)
    : map_(std::move(map)), not_before_(map_->database().points.size(), 0) {
  slots_.reserve(kMostSlots);
  for (Fit* fit : {&fit_, &searched_}) {
    fit->sights.reserve(kMostSlots);
    fit->matches.reserve(kMostSlots);
    fit->pose.squares.reserve(kMostSlots);
  }
  seen_.reserve(kMostSlots);
  depths_.reserve(kMostSlots);
  const auto keyframes = static_cast<uint32_t>(map_->database().keyframes.size());
  for (uint32_t k = 0; k < keyframes; ++k) {
    scale_ += map_->median_depth(k) / keyframes;
  }
}

// --- Occluders

void Follower::SetOccluders(std::span<const OccluderMesh> meshes) {
  DoubtOccluders();
  occluders_.Set(meshes);
  for (Slot& slot : slots_) {
    slot.occluder = OccluderSet::kNone;
  }
}

uint32_t Follower::HiddenBy(const Eigen::Vector3d& point, const Eigen::Vector3d& eye) const {
  if (occluders_.empty()) {
    return OccluderSet::kNone;
  }
  return occluders_.HiddenBy(eye, point, kHidingBias * std::max((point - eye).norm(), scale_));
}

void Follower::HideSlots(const Eigen::Vector3d& eye) {
  if (occluders_.empty()) {
    return;
  }
  size_t left = 0;
  for (Slot& slot : slots_) {
    if ((slot.point + now_) % kHideInterval == 0) {
      slot.occluder = HiddenBy(slot.point_in_map, eye);
    }
    slot.hidden =
        slot.occluder != OccluderSet::kNone && occluders_.believed(slot.occluder) && !slot.trial;
    left += slot.hidden ? 0 : 1;
  }
  if (left < std::min(kLeastLeft, slots_.size())) {
    DoubtOccluders();
  }
}

// Tells the occluders whether what they hide was seen, each slot once: those that are
// seen stay, and would outvote the others.
void Follower::SettleHidden(const CameraModel& camera, const Rigid3& camera_from_map) {
  for (size_t i = slots_.size(); i-- > 0;) {
    Slot& slot = slots_[i];
    if (slot.occluder == OccluderSet::kNone) {
      continue;
    }
    View view;
    if (!slot.hidden && !slot.noted && ViewSlot(camera, camera_from_map, slot, view)) {
      occluders_.Note(slot.occluder, slot.failures == 0);
      slot.noted = true;
    }
    if (slot.hidden || slot.trial) {
      RemoveSlot(i, kRestHidden);
    }
  }
}

// What was hidden may be chosen again.
void Follower::DoubtOccluders() {
  if (!occluders_.Doubt()) {
    return;
  }
  for (uint32_t& not_before : not_before_) {
    not_before = not_before == kUsed ? kUsed : 0;
  }
  for (Slot& slot : slots_) {
    slot.hidden = false;
  }
}

// --- Fresh patches

const ImagePyramid& Follower::ImageOf(const Slot& slot) const {
  return slot.keyframe >= kFresh ? fresh_[slot.keyframe - kFresh].image
                                 : map_->pyramid(slot.keyframe);
}

const Rigid3& Follower::PoseOf(const Slot& slot) const {
  return slot.keyframe >= kFresh ? fresh_[slot.keyframe - kFresh].camera_from_map
                                 : map_->database().keyframes[slot.keyframe].camera_from_map;
}

uint32_t Follower::LeastUsedFresh() const {
  std::array<size_t, kFreshFrames> uses{};
  for (const Slot& slot : slots_) {
    if (slot.keyframe >= kFresh) {
      ++uses[slot.keyframe - kFresh];
    }
  }
  return static_cast<uint32_t>(std::min_element(uses.begin(), uses.end()) - uses.begin());
}

// Whether the image shows the patch of a keyframe where the detector saw the point.
bool Follower::ShowsKeyframePatch(Slot& slot,
                                  const ImagePyramid& image,
                                  const CameraModel& camera,
                                  const Rigid3& camera_from_map,
                                  const LocatedPoint& seen) {
  View view;
  PatchTemplate patch;
  PatchFit fit;
  if (!AimSlot(slot, camera_from_map) || !ViewSlot(camera, camera_from_map, slot, view) ||
      !SampleSlot(slot, view, 0, patch)) {
    return false;
  }
  return AlignPatch(image.level(0), patch, view.pixel.cast<float>(), {}, fit) &&
         fit.correlation >= kLeastCorrelation &&
         (fit.centre - seen.pixel).norm() < 1.0f + 3.0f * seen.sigma_px;
}

// Lays the slot's patch where the detector saw the point in a fresh image; the
// surface is that of the keyframe that saw it most alike.
bool Follower::AimAtFresh(Slot& slot, uint32_t fresh, const LocatedPoint& seen) {
  const FreshFrame& frame = fresh_[fresh];
  const uint32_t keyframe =
      LeastUnlike(slot.point, frame.camera_from_map, std::numeric_limits<float>::infinity());
  if (keyframe == kUsed) {
    return false;
  }
  // n . (R p + t) = 1 for the points p of the plane.
  const Rigid3 key_from_fresh =
      map_->database().keyframes[keyframe].camera_from_map * frame.camera_from_map.Inverse();
  const Eigen::Vector3d n = map_->PlaneAt(keyframe, slot.point);
  const double distance = 1.0 - n.dot(key_from_fresh.translation);
  if (!(distance > 1e-3)) {
    return false;  // the surface is seen from its edge or from behind
  }
  slot.tangent = key_from_fresh.rotation.conjugate() * n / distance;
  slot.keyframe = kFresh + fresh;
  slot.sigma_px = seen.sigma_px;
  slot.key_pixel = seen.pixel.cast<double>();
  slot.key_plane = frame.camera.PlaneFromPixel(slot.key_pixel);
  slot.plane_from_key_pixel = PixelFromPlaneSlope(frame.camera, slot.key_plane).inverse();
  return InsideBy(frame.camera, slot.key_pixel, kBorderPx);
}

void Follower::Merge(ImagePyramid& image,
                     const CameraModel& camera,
                     const Rigid3& camera_from_map,
                     std::span<const LocatedPoint> points,
                     const Rigid3& camera_from_map_now) {
  for (size_t i = slots_.size(); i-- > 0;) {
    if (slots_[i].failures > 0) {
      RemoveSlot(i, kRestFailed);
    }
  }
  has_motion_ = false;  // the image shows what it shows
  CountCells(camera, camera_from_map_now);
  const int quota = slots_.size() < kMostSlots / 2 ? 2 : 1;
  const Eigen::Vector3d eye = camera_from_map_now.Center();
  const ImagePyramid* shown = &image;
  uint32_t fresh = kFreshFrames;  // none yet
  for (const LocatedPoint& seen : points) {
    if (slots_.size() >= kMostSlots) {
      break;
    }
    Slot slot;
    slot.point = seen.point;
    slot.point_in_map = map_->database().points[seen.point].cast<double>();
    const auto pixel = camera.Project(camera_from_map_now * slot.point_in_map);
    if (not_before_[seen.point] == kUsed || !pixel || !InsideBy(camera, *pixel, kBorderPx)) {
      continue;
    }
    const auto cell = static_cast<size_t>(CellIn(camera, *pixel, kColumns, kRows));
    if (cell_counts_[cell] >= quota) {
      continue;
    }
    slot.occluder = HiddenBy(slot.point_in_map, eye);
    if (slot.occluder != OccluderSet::kNone && occluders_.believed(slot.occluder)) {
      continue;
    }
    if (!ShowsKeyframePatch(slot, *shown, camera, camera_from_map, seen)) {
      if (fresh == kFreshFrames) {
        fresh = LeastUsedFresh();
        for (size_t i = slots_.size(); i-- > 0;) {
          if (slots_[i].keyframe == kFresh + fresh) {
            RemoveSlot(i, 0);
          }
        }
        std::swap(image, fresh_[fresh].image);
        fresh_[fresh].camera = camera;
        fresh_[fresh].camera_from_map = camera_from_map;
        shown = &fresh_[fresh].image;
      }
      View view;
      PatchTemplate patch;
      if (!AimAtFresh(slot, fresh, seen) || !ViewSlot(camera, camera_from_map, slot, view) ||
          !SampleSlot(slot, view, 0, patch)) {
        continue;
      }
    }
    not_before_[slot.point] = kUsed;
    slots_.push_back(slot);
    ++cell_counts_[cell];
  }
}

// --- Choosing patches

// How unlike the view of a point is to that of a keyframe: the angle between the
// lines of sight, and the ratio of the distances.
float Follower::Unlike(const Rigid3& key_from_map,
                       const Eigen::Vector3d& point,
                       const Rigid3& camera_from_map) {
  const Eigen::Vector3d to_camera = camera_from_map.Center() - point;
  const Eigen::Vector3d to_keyframe = key_from_map.Center() - point;
  const double near = to_camera.norm();
  const double near_key = to_keyframe.norm();
  const double sine = to_camera.cross(to_keyframe).norm();
  const double angle = std::atan2(sine, to_camera.dot(to_keyframe));
  const double zoom = std::log(near_key / near);
  // A keyframe from farther away shows less detail: twice as bad as one from nearer.
  const double scale = zoom > 0.0 ? 0.6 * zoom : -0.3 * zoom;
  return static_cast<float>(angle + scale);
}

// The keyframe whose view of a point is least unlike, and less than most; kUsed
// without. A little chance spreads points over keyframes that are about as good, so
// that their errors average out.
uint32_t Follower::LeastUnlike(uint32_t point, const Rigid3& camera_from_map, float most) const {
  const SceneDatabase& db = map_->database();
  const Eigen::Vector3d p = db.points[point].cast<double>();
  uint32_t best = kUsed;
  for (const uint32_t keyframe : map_->KeyframesOf(point)) {
    const float unlike = Unlike(db.keyframes[keyframe].camera_from_map, p, camera_from_map) +
                         0.03f * Hash(keyframe, point);
    if (unlike < most) {
      most = unlike;
      best = keyframe;
    }
  }
  return best;
}

// Chooses the keyframe of a slot; false where none serves. A fresh patch stays while
// it serves.
bool Follower::AimSlot(Slot& slot, const Rigid3& camera_from_map) {
  constexpr float kMostUnlike = 0.8f;
  if (slot.keyframe >= kFresh) {
    return Unlike(PoseOf(slot), slot.point_in_map, camera_from_map) < kMostUnlike;
  }
  const uint32_t best = LeastUnlike(slot.point, camera_from_map, kMostUnlike);
  if (best == kUsed) {
    return false;
  }
  if (best == slot.keyframe && slot.tangent.squaredNorm() > 0.0) {
    return true;
  }
  const SceneDatabase& db = map_->database();
  const Eigen::Vector3d p = db.keyframes[best].camera_from_map * slot.point_in_map;
  if (p.z() <= 0.0) {
    return false;
  }
  slot.keyframe = best;
  slot.key_plane = p.hnormalized();
  slot.key_pixel = db.camera.PixelFromPlane(slot.key_plane);
  slot.tangent = map_->PlaneAt(best, slot.point);
  slot.plane_from_key_pixel = PixelFromPlaneSlope(db.camera, slot.key_plane).inverse();
  return InsideBy(db.camera, slot.key_pixel, kBorderPx);
}

void Follower::RankKeyframes(const Rigid3& camera_from_map) {
  const SceneDatabase& db = map_->database();
  std::array<double, kNearKeyframes> scores;
  near_count_ = 0;
  const Eigen::Vector3d centre = camera_from_map.Center();
  const Eigen::Vector3d axis = camera_from_map.rotation.conjugate() * Eigen::Vector3d::UnitZ();
  for (uint32_t k = 0; k < db.keyframes.size(); ++k) {
    const double depth = map_->median_depth(k);
    if (depth <= 0.0 || map_->pyramid(k).levels() == 0) {
      continue;
    }
    const Rigid3& pose = db.keyframes[k].camera_from_map;
    const Eigen::Vector3d key_axis = pose.rotation.conjugate() * Eigen::Vector3d::UnitZ();
    const double score = (pose.Center() - centre).norm() / depth +
                         std::acos(std::clamp(axis.dot(key_axis), -1.0, 1.0));
    size_t place = near_count_ < kNearKeyframes ? near_count_++ : kNearKeyframes;
    if (place == kNearKeyframes) {
      if (score >= scores[kNearKeyframes - 1]) {
        continue;
      }
      place = kNearKeyframes - 1;
    }
    while (place > 0 && scores[place - 1] > score) {
      scores[place] = scores[place - 1];
      near_[place] = near_[place - 1];
      --place;
    }
    scores[place] = score;
    near_[place] = k;
  }
}

void Follower::CountCells(const CameraModel& camera, const Rigid3& camera_from_map) {
  cell_counts_.fill(0);
  for (const Slot& slot : slots_) {
    const auto pixel = camera.Project(camera_from_map * slot.point_in_map);
    if (pixel && camera.Contains(*pixel)) {
      ++cell_counts_[static_cast<size_t>(CellIn(camera, *pixel, kColumns, kRows))];
    }
  }
}

bool Follower::AddSlot(uint32_t point,
                       const CameraModel& camera,
                       const Rigid3& camera_from_map,
                       uint32_t occluder,
                       bool trial) {
  Slot slot;
  slot.point = point;
  slot.occluder = occluder;
  slot.point_in_map = map_->database().points[point].cast<double>();
  slot.trial = trial;
  View view;
  PatchTemplate patch;
  if (!AimSlot(slot, camera_from_map) || !ViewSlot(camera, camera_from_map, slot, view) ||
      !SampleSlot(slot, view, 0, patch)) {
    not_before_[point] = now_ + kRestUseless;
    return false;
  }
  not_before_[point] = kUsed;
  slots_.push_back(slot);
  return true;
}

// Adds at most one point of the keyframe to each cell that holds fewer than quota.
void Follower::AddFrom(uint32_t keyframe,
                       const CameraModel& camera,
                       const Rigid3& camera_from_map,
                       int quota) {
  struct Candidate {
    uint32_t point = kUsed;
    float merit = -std::numeric_limits<float>::infinity();
    uint32_t occluder = OccluderSet::kNone;
  };
  std::array<Candidate, kCells> best;
  std::array<Candidate, kTrials> trials;
  size_t trial_count = 0;
  const Eigen::Vector3d eye = camera_from_map.Center();
  const SceneDatabase& db = map_->database();
  const Eigen::Matrix3f rotation = camera_from_map.rotation.toRotationMatrix().cast<float>();
  const Eigen::Vector3f translation = camera_from_map.translation.cast<float>();
  const auto fx = static_cast<float>(camera.fx);
  const auto fy = static_cast<float>(camera.fy);
  const auto cx = static_cast<float>(camera.cx);
  const auto cy = static_cast<float>(camera.cy);
  for (const Observation& o : map_->ObservationsIn(keyframe)) {
    if (not_before_[o.point] > now_) {
      continue;
    }
    const Eigen::Vector3f p = rotation * db.points[o.point] + translation;
    if (p.z() <= 0.0f) {
      continue;
    }
    Eigen::Vector2d pixel(fx * p.x() / p.z() + cx, fy * p.y() / p.z() + cy);
    if (camera.HasDistortion()) {
      const Eigen::Vector2d plane = p.hnormalized().cast<double>();
      if (camera.FoldsBackAt(plane)) {
        continue;
      }
      pixel = camera.PixelFromPlane(plane);
    }
    if (!InsideBy(camera, pixel, kBorderPx)) {
      continue;
    }
    const auto cell = static_cast<size_t>(CellIn(camera, pixel, kColumns, kRows));
    if (cell_counts_[cell] >= quota) {
      continue;
    }
    // Seen often, hence well known; of fine structure.
    const float merit = std::log2(static_cast<float>(db.observation_counts[o.point])) -
                        std::log2(std::max(o.scale, 1.0f));
    if (merit <= best[cell].merit) {
      continue;
    }
    const uint32_t occluder = HiddenBy(db.points[o.point].cast<double>(), eye);
    if (occluder != OccluderSet::kNone && occluders_.believed(occluder)) {
      constexpr float kTried = 0.1f;  // share of them, so that any may be
      not_before_[o.point] = now_ + kRestHidden;
      if (trial_count < kTrials && Hash(o.point, now_) < kTried) {
        trials[trial_count++] = {o.point, merit, occluder};
      }
      continue;
    }
    best[cell] = {o.point, merit, occluder};
  }
  for (size_t cell = 0; cell < kCells && slots_.size() < kMostSlots; ++cell) {
    const Candidate& c = best[cell];
    if (c.point != kUsed && AddSlot(c.point, camera, camera_from_map, c.occluder, false)) {
      ++cell_counts_[cell];
    }
  }
  for (size_t i = 0; i < trial_count && slots_.size() < kMostSlots; ++i) {
    AddSlot(trials[i].point, camera, camera_from_map, trials[i].occluder, true);
  }
}

void Follower::RemoveSlot(size_t index, uint32_t rest) {
  not_before_[slots_[index].point] = now_ + rest;
  slots_[index] = slots_.back();
  slots_.pop_back();
}

void Follower::Start(const CameraModel& camera, const Rigid3& camera_from_map) {
  while (!slots_.empty()) {
    RemoveSlot(slots_.size() - 1, 0);
  }
  has_motion_ = false;
  has_motion_before_ = false;
  if (fresh_[0].image.levels() == 0) {
    // Memory for later.
    const cv::Mat blank(camera.height, camera.width, CV_8UC1, cv::Scalar(0));
    for (FreshFrame& fresh : fresh_) {
      fresh.image.Build(blank, CoarsestLevel(camera.width) + 2);
    }
  }
  RankKeyframes(camera_from_map);
  const auto fill = [&] {
    CountCells(camera, camera_from_map);
    for (int quota = 1; quota <= 3; ++quota) {
      for (size_t i = 0; i < near_count_; ++i) {
        AddFrom(near_[i], camera, camera_from_map, quota);
      }
    }
  };
  fill();
  if (slots_.size() < kLeastLeft && !occluders_.empty()) {
    DoubtOccluders();
    fill();
  }
}

// --- Where and how a patch is seen

bool Follower::ViewSlot(const CameraModel& camera,
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
  // The tangent plane maps the keyframe's plane z = 1 to the camera's by the
  // homography R + t n^T.
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
  // Turned over, seen from its edge, or much larger than in the keyframe.
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

bool Follower::SampleSlot(const Slot& slot,
                          const View& view,
                          int level,
                          PatchTemplate& patch) const {
  const ImagePyramid& pyramid = ImageOf(slot);
  // The keyframe's level whose pixels are about as large.
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

void Follower::Fit::Clear() {
  sights.clear();
  matches.clear();
}

void Follower::AddSight(
    const CameraModel& camera, uint32_t slot, int level, const PatchFit& patch, Fit& fit) const {
  fit.sights.push_back({slot, PixelFromLevel(patch.centre, level)});
  const double size = 1 << level;
  const Eigen::Vector2d pixel = PixelFromLevel(Eigen::Vector2d(patch.centre.cast<double>()), level);
  const Eigen::Matrix2d information =
      patch.information.cast<double>() / (kNoiseInflation * size * size);
  // Inverse of (information^-1 + error^2), which stands edges.
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

bool Follower::RunLevel(const ImagePyramid& image,
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
    AddSight(camera, i, level, fit, fit_);
  }
  if (!EstimatePatchPose(fit_.matches, camera_from_map, kLeastScale, fit_.pose)) {
    return false;
  }
  camera_from_map = fit_.pose.camera_from_map;
  return true;
}

bool Follower::SearchLevel(const ImagePyramid& image,
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
      AddSight(camera, i, level, fit, searched_);
    }
  }
  if (!EstimatePatchPose(searched_.matches, camera_from_map, kLeastScale, searched_.pose) ||
      searched_.pose.inliers <= least) {
    return false;
  }
  std::swap(fit_, searched_);
  camera_from_map = fit_.pose.camera_from_map;
  return true;
}

// The prediction at which the patches look most alike on the coarsest level.
Rigid3 Follower::BestPrediction(const ImagePyramid& image,
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

// The motion during a frame's time around this frame, from the motions since the
// frame before and before that.
void Follower::SetMotion(const Rigid3& camera_from_map) {
  if (!has_motion_) {
    return;
  }
  const Rigid3 since = camera_from_map * before_.Inverse();
  motion_.head<3>() = geometry::VectorFromRotation(since.rotation) / frames_;
  motion_.tail<3>() = since.translation / frames_;
  // The velocity of now, not of half a frame ago.
  const Vector6d acceleration =
      has_motion_before_ ? Vector6d(motion_ - motion_before_) : Vector6d::Zero();
  velocity_ = ExpMotion(motion_ + 0.5 * acceleration);
  acceleration_ = ExpMotion(acceleration);
}

// Mean length of the patches' paths during the exposure, pixels.
double Follower::BlurPx(const CameraModel& camera, const Rigid3& camera_from_map) const {
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

// How alike the patches that agree look for a shutter time; they stay where they
// were found.
double Follower::Likeness(const ImagePyramid& image,
                          const CameraModel& camera,
                          int level,
                          const Rigid3& camera_from_map,
                          double shutter) {
  constexpr size_t kSample = 40;
  const double kept = std::exchange(shutter_, shutter);
  double sum = 0.0;
  const size_t stride = std::max(size_t{1}, fit_.sights.size() / kSample);
  for (size_t i = 0; i < fit_.sights.size(); i += stride) {
    View view;
    PatchTemplate patch;
    if (fit_.pose.squares[i] < kInlierSquare &&
        ViewSlot(camera, camera_from_map, slots_[fit_.sights[i].slot], view) &&
        SampleSlot(slots_[fit_.sights[i].slot], view, level, patch)) {
      sum += CorrelatePatch(image.level(level), patch, LevelFromPixel(fit_.sights[i].pixel, level));
    }
  }
  shutter_ = kept;
  return sum;
}

// Fast motion shows for how long the shutter is open: a step towards the summit of
// the parabola through three trials.
void Follower::EstimateShutter(const ImagePyramid& image,
                               const CameraModel& camera,
                               int level,
                               const Rigid3& camera_from_map) {
  constexpr double kTrial = 0.15;
  constexpr double kLeastShare = 0.25;   // of the step, once settled
  constexpr double kLeastShownPx = 3.0;  // in a whole frame's time, on the level
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

// The finest level on which blur leaves something to align. What it leaves on finer
// ones are the ends of the path, which show the speed at the ends as much as the
// place in the middle.
int Follower::FinestLevel(const CameraModel& camera, const Rigid3& camera_from_map) const {
  constexpr double kMostBlurPx = 8.0;  // on the level
  const double blur = BlurPx(camera, camera_from_map);
  return blur > kMostBlurPx ? static_cast<int>(std::ceil(std::log2(blur / kMostBlurPx))) : 0;
}

// Mean square of the acceleration of late. Before any was seen the motion may have
// begun just now: it is as large as that.
Matrix6d Follower::Accelerations() const {
  return knows_accelerations_ ? accelerations_ : Matrix6d(motion_ * motion_.transpose());
}

// That of the patches as if each erred by itself, more for what they share: the
// errors of their keyframes' poses, and the part of the acceleration during the
// exposure that the frames before do not foretell.
Matrix6d Follower::Covariance() const {
  constexpr double kSharedErrors = 2.0;
  Matrix6d covariance = kSharedErrors * fit_.pose.covariance;
  if (has_motion_) {
    constexpr double kUnforeseen = 1.0 / 16.0;  // of the path's length, shutter^2 a
    const double share = kUnforeseen * shutter_ * shutter_;
    const Matrix6d accelerations = Accelerations();
    Matrix6d doubt = accelerations;
    doubt.diagonal().head<3>().array() += accelerations.diagonal().head<3>().mean();
    doubt.diagonal().tail<3>().array() += accelerations.diagonal().tail<3>().mean();
    covariance += share * share * doubt;
  }
  return covariance;
}

FollowedPose Follower::Follow(const ImagePyramid& image,
                              const CameraModel& camera,
                              std::span<const Rigid3> predictions,
                              const Rigid3* before,
                              double frames) {
  FollowedPose result;
  ++now_;
  has_motion_ = before != nullptr;
  if (before != nullptr) {
    before_ = *before;
    frames_ = frames;
  }
  HideSlots(predictions[0].Center());
  Rigid3 pose = BestPrediction(image, camera, predictions);
  const int coarsest = Coarsest(image);
  int finest = 0;
  for (int level = coarsest; level >= finest; --level) {
    SetMotion(pose);
    finest = std::min(FinestLevel(camera, pose), level);
    const int wanted = level == finest ? 1000 : level == coarsest ? 60 : 100;
    const int stride = std::max(1, static_cast<int>(slots_.size()) / wanted);
    Rigid3 moved = pose;
    bool found = RunLevel(image, camera, level, stride, moved, result.expected);
    if (level == coarsest && (!found || 3 * fit_.pose.inliers < result.expected)) {
      Rigid3 searched = pose;
      if (SearchLevel(image, camera, level, stride, found ? fit_.pose.inliers : 0, searched)) {
        moved = searched;
        found = true;
      }
    }
    if (found) {
      pose = moved;
    } else if (level == finest) {
      return result;
    }
  }
  result.camera_from_map = pose;
  result.evidence.covariance = Covariance();
  result.agreeing = fit_.pose.inliers;
  if (!has_motion_ && result.agreeing > 0) {
    // Blur of an unknown motion shows in patches that are not found; what it does to
    // the others they have in common.
    result.evidence.covariance /= result.share() * result.share();
  }
  Judge(camera, result);
  if (result.honest) {
    EstimateShutter(image, camera, finest, pose);
    result.blur_px = BlurPx(camera, pose);
    Settle(camera, result);
  }
  return result;
}

void Follower::Judge(const CameraModel& camera, FollowedPose& pose) {
  CHECK(fit_.sights.size() == fit_.pose.squares.size());
  std::array<bool, kSpreadColumns * kSpreadRows> covered{};
  int cells = 0;
  depths_.clear();
  for (size_t i = 0; i < fit_.sights.size(); ++i) {
    if (fit_.pose.squares[i] >= kInlierSquare) {
      continue;
    }
    const Eigen::Vector2d pixel = fit_.sights[i].pixel.cast<double>();
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
  const double variance = ComputeRegistrationVariance(camera, pose.evidence).Sum();
  pose.expected_error_px = std::sqrt(variance);
  pose.honest = pose.agreeing >= kLeastAgreeing && pose.share() >= kLeastShare &&
                cells >= kLeastCells && pose.expected_error_px < kLargestErrorPx;
}

// Takes note of who agreed, lets go of who did not, and looks for others.
void Follower::Settle(const CameraModel& camera, const FollowedPose& pose) {
  SetMotion(pose.camera_from_map);
  if (has_motion_) {
    accelerations_ = Accelerations();
    knows_accelerations_ = true;
  }
  if (has_motion_ && has_motion_before_) {
    constexpr double kMemory = 0.7;
    const Vector6d acceleration = motion_ - motion_before_;
    accelerations_ =
        kMemory * accelerations_ + (1.0 - kMemory) * acceleration * acceleration.transpose();
  }
  has_motion_before_ = has_motion_;
  motion_before_ = motion_;
  seen_.clear();
  for (Slot& slot : slots_) {
    ++slot.failures;
  }
  for (size_t i = 0; i < fit_.sights.size(); ++i) {
    if (fit_.pose.squares[i] < kInlierSquare) {
      Slot& slot = slots_[fit_.sights[i].slot];
      slot.failures = 0;
      seen_.push_back({slot.point, fit_.sights[i].pixel});
    }
  }
  SettleHidden(camera, pose.camera_from_map);
  for (size_t i = slots_.size(); i-- > 0;) {
    Slot& slot = slots_[i];
    const auto pixel = camera.Project(pose.camera_from_map * slot.point_in_map);
    if (!pixel || !camera.Contains(*pixel)) {
      RemoveSlot(i, 0);
    } else if (slot.failures >= kMostFailures) {
      RemoveSlot(i, kRestFailed);
    } else if ((slot.point + now_) % kAimInterval == 0 && !AimSlot(slot, pose.camera_from_map)) {
      RemoveSlot(i, kRestFailed);
    }
  }
  CountCells(camera, pose.camera_from_map);
  if (next_near_ >= near_count_) {
    RankKeyframes(pose.camera_from_map);
    next_near_ = 0;
  }
  if (near_count_ > 0 && slots_.size() < kMostSlots) {
    AddFrom(near_[next_near_++], camera, pose.camera_from_map,
            slots_.size() < kMostSlots / 2 ? 2 : 1);
  }
}

}  // namespace lararium::vision
