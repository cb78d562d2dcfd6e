#include <algorithm>
#include <cmath>
#include <utility>

#include "shared/vision/patch_tracker.h"
#include "shared/vision/patch_tracker_parts.h"

namespace lararium::vision {
namespace {

using geometry::CameraModel;
using geometry::Rigid3;

constexpr uint32_t kUsed = 0xffffffff;
constexpr uint32_t kRestUseless =
    300;  // Frames until a point without a usable patch is tried again.
// Occluder bias as a share of the distance. It allows for the accuracy of the models; therefore
// objects thinner than this hide nothing.
constexpr double kHidingBias = 0.02;
constexpr uint32_t kHideInterval = 4;  // Frames between occlusion tests of a slot.
constexpr uint32_t kRestHidden = 15;   // Frames until a hidden point is considered again.
constexpr size_t kTrials = 4;          // Maximum number of hidden points searched for per frame.
constexpr size_t kLeastLeft = 40;      // Number of slots that trusted occluders must leave.

// A pseudo-random number in 0..1 that depends on both arguments only.
float Hash(uint32_t a, uint32_t b) {
  uint32_t h = a * 0x9e3779b1u ^ (b + 0x7f4a7c15u) * 0x85ebca6bu;
  h ^= h >> 15;
  h *= 0xc2b2ae35u;
  h ^= h >> 13;
  return static_cast<float>(h >> 8) * 0x1p-24f;
}

}  // namespace

// --- Occluders

void PatchTracker::SetOccluders(std::span<const OccluderMesh> meshes) {
  DoubtOccluders();
  occluders_.Set(meshes);
  for (Slot& slot : slots_) {
    slot.occluder = OccluderSet::kNone;
  }
}

uint32_t PatchTracker::HiddenBy(const Eigen::Vector3d& point, const Eigen::Vector3d& eye) const {
  if (occluders_.empty()) {
    return OccluderSet::kNone;
  }
  return occluders_.HiddenBy(eye, point, kHidingBias * std::max((point - eye).norm(), scale_));
}

void PatchTracker::HideSlots(const Eigen::Vector3d& eye) {
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

// Tells the occluders whether the points behind them were found. Each slot counts once, because
// slots that are found stay and would outvote the others.
void PatchTracker::SettleHidden(const CameraModel& camera, const Rigid3& camera_from_map) {
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

// Withdraws trust from the occluders and makes the hidden points available again.
void PatchTracker::DoubtOccluders() {
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

const ImagePyramid& PatchTracker::ImageOf(const Slot& slot) const {
  return slot.keyframe >= kFresh ? fresh_[slot.keyframe - kFresh].image
                                 : map_->pyramid(slot.keyframe);
}

const Rigid3& PatchTracker::PoseOf(const Slot& slot) const {
  return slot.keyframe >= kFresh ? fresh_[slot.keyframe - kFresh].camera_from_map
                                 : map_->database().keyframes[slot.keyframe].camera_from_map;
}

uint32_t PatchTracker::LeastUsedFresh() const {
  std::array<size_t, kFreshFrames> uses{};
  for (const Slot& slot : slots_) {
    if (slot.keyframe >= kFresh) {
      ++uses[slot.keyframe - kFresh];
    }
  }
  return static_cast<uint32_t>(std::min_element(uses.begin(), uses.end()) - uses.begin());
}

// Returns whether a keyframe's patch matches the image at the position of the detected feature.
bool PatchTracker::ShowsKeyframePatch(Slot& slot,
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

// Takes the slot's patch from a fresh image, centred on the detected feature. The tangent plane is
// taken from the keyframe with the most similar view.
bool PatchTracker::AimAtFresh(Slot& slot, uint32_t fresh, const LocatedPoint& seen) {
  const FreshFrame& frame = fresh_[fresh];
  const uint32_t keyframe =
      LeastUnlike(slot.point, frame.camera_from_map, std::numeric_limits<float>::infinity());
  if (keyframe == kUsed) {
    return false;
  }
  // The points p of the plane in the fresh camera's frame satisfy n . (R p + t) = 1.
  const Rigid3 key_from_fresh =
      map_->database().keyframes[keyframe].camera_from_map * frame.camera_from_map.Inverse();
  const Eigen::Vector3d n = map_->PlaneAt(keyframe, slot.point);
  const double distance = 1.0 - n.dot(key_from_fresh.translation);
  if (!(distance > 1e-3)) {
    return false;  // The surface is seen edge-on or from behind.
  }
  slot.tangent = key_from_fresh.rotation.conjugate() * n / distance;
  slot.keyframe = kFresh + fresh;
  slot.sigma_px = seen.sigma_px;
  slot.key_pixel = seen.pixel.cast<double>();
  slot.key_plane = frame.camera.PlaneFromPixel(slot.key_pixel);
  slot.plane_from_key_pixel = PixelFromPlaneSlope(frame.camera, slot.key_plane).inverse();
  return InsideBy(frame.camera, slot.key_pixel, kBorderPx);
}

void PatchTracker::Merge(ImagePyramid& image,
                         const CameraModel& camera,
                         const Rigid3& camera_from_map,
                         std::span<const LocatedPoint> points,
                         const Rigid3& camera_from_map_now) {
  for (size_t i = slots_.size(); i-- > 0;) {
    if (slots_[i].failures > 0) {
      RemoveSlot(i, kRestFailed);
    }
  }
  has_motion_ = false;  // Patches from the image itself already contain its blur.
  CountCells(camera, camera_from_map_now);
  const int quota = slots_.size() < kMostSlots / 2 ? 2 : 1;
  const Eigen::Vector3d eye = camera_from_map_now.Center();
  const ImagePyramid* shown = &image;
  uint32_t fresh = kFreshFrames;  // No fresh frame is in use yet.
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

// The difference between the camera's view of a point and a keyframe's view: the angle between the
// viewing rays in radians, plus a penalty for the ratio of the distances.
float PatchTracker::Unlike(const Rigid3& key_from_map,
                           const Eigen::Vector3d& point,
                           const Rigid3& camera_from_map) {
  const Eigen::Vector3d to_camera = camera_from_map.Center() - point;
  const Eigen::Vector3d to_keyframe = key_from_map.Center() - point;
  const double near = to_camera.norm();
  const double near_key = to_keyframe.norm();
  const double sine = to_camera.cross(to_keyframe).norm();
  const double angle = std::atan2(sine, to_camera.dot(to_keyframe));
  const double zoom = std::log(near_key / near);
  // A keyframe from farther away shows less detail and is penalised twice as much as a nearer one.
  const double scale = zoom > 0.0 ? 0.6 * zoom : -0.3 * zoom;
  return static_cast<float>(angle + scale);
}

// The keyframe with the most similar view of a point, if the difference is below `most`; otherwise
// kUsed. A small random term spreads points over keyframes of about equal quality, so that the
// errors of the keyframes average out.
uint32_t PatchTracker::LeastUnlike(uint32_t point,
                                   const Rigid3& camera_from_map,
                                   float most) const {
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

// Chooses the keyframe of a slot. Returns false if no keyframe is suitable. A fresh patch is kept
// as long as its view is similar enough.
bool PatchTracker::AimSlot(Slot& slot, const Rigid3& camera_from_map) {
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

void PatchTracker::RankKeyframes(const Rigid3& camera_from_map) {
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

void PatchTracker::CountCells(const CameraModel& camera, const Rigid3& camera_from_map) {
  cell_counts_.fill(0);
  for (const Slot& slot : slots_) {
    const auto pixel = camera.Project(camera_from_map * slot.point_in_map);
    if (pixel && camera.Contains(*pixel)) {
      ++cell_counts_[static_cast<size_t>(CellIn(camera, *pixel, kColumns, kRows))];
    }
  }
}

bool PatchTracker::AddSlot(uint32_t point,
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
void PatchTracker::AddFrom(uint32_t keyframe,
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
    // Points with many observations are accurate; small keypoints have fine structure.
    const float merit = std::log2(static_cast<float>(db.observation_counts[o.point])) -
                        std::log2(std::max(o.scale, 1.0f));
    if (merit <= best[cell].merit) {
      continue;
    }
    const uint32_t occluder = HiddenBy(db.points[o.point].cast<double>(), eye);
    if (occluder != OccluderSet::kNone && occluders_.believed(occluder)) {
      constexpr float kTried = 0.1f;  // Random share of the hidden points that are tested.
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

void PatchTracker::RemoveSlot(size_t index, uint32_t rest) {
  not_before_[slots_[index].point] = now_ + rest;
  slots_[index] = slots_.back();
  slots_.pop_back();
}

void PatchTracker::Start(const CameraModel& camera, const Rigid3& camera_from_map) {
  while (!slots_.empty()) {
    RemoveSlot(slots_.size() - 1, 0);
  }
  has_motion_ = false;
  has_motion_before_ = false;
  if (fresh_[0].image.levels() == 0) {
    // Allocates the memory that Merge() needs later.
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

}  // namespace lararium::vision
