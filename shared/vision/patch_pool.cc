#include "shared/vision/patch_pool.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace lararium::vision {
namespace {

using geometry::CameraModel;
using geometry::Rigid3;

constexpr int kMostFailures = 4;
constexpr uint32_t kAimInterval = 8;  // Images between searches for a better keyframe of a patch.
constexpr uint32_t kUsed = 0xffffffff;
constexpr uint32_t kRestFailed = 20;    // Images until a failed point may be chosen again.
constexpr uint32_t kRestUseless = 300;  // Images until a point without a usable patch is retried.
// Occluder bias as a share of the distance. It allows for the accuracy of the models; therefore
// objects thinner than this hide nothing.
constexpr double kHidingBias = 0.02;
constexpr uint32_t kHideInterval = 4;  // Images between occlusion tests of a slot.
constexpr uint32_t kRestHidden = 15;   // Images until a hidden point is considered again.
constexpr size_t kTrials = 4;          // Maximum number of hidden points searched for per image.
constexpr size_t kLeastLeft = 40;      // Number of slots that trusted occluders must leave.

}  // namespace

int CellIn(const CameraModel& camera, const Eigen::Vector2d& pixel, int columns, int rows) {
  const int column =
      std::clamp(static_cast<int>(pixel.x() * columns / camera.width), 0, columns - 1);
  const int row = std::clamp(static_cast<int>(pixel.y() * rows / camera.height), 0, rows - 1);
  return row * columns + column;
}

PatchPool::PatchPool(std::shared_ptr<const TrackedMap> map)
    : source_(std::move(map)), not_before_(database().points.size(), 0) {
  slots_.reserve(kMostPatches);
  const auto keyframes = static_cast<uint32_t>(database().keyframes.size());
  for (uint32_t k = 0; k < keyframes; ++k) {
    scale_ += source_.map().median_depth(k) / keyframes;
  }
}

void PatchPool::SetOccluders(std::span<const OccluderMesh> meshes) {
  DoubtOccluders();
  occluders_.Set(meshes);
  for (Slot& slot : slots_) {
    slot.occluder = OccluderSet::kNone;
  }
}

void PatchPool::Start(const CameraModel& camera, const Rigid3& camera_from_map) {
  while (!slots_.empty()) {
    RemoveSlot(slots_.size() - 1, 0);
  }
  source_.AllocateFresh(camera);
  RankKeyframes(camera_from_map);
  const auto fill = [&] {
    CountCells(camera, camera_from_map);
    for (int quota = 1; quota <= 3; ++quota) {
      for (size_t i = 0; i < near_count_; ++i) {
        AddFrom(near_[i], {camera, camera_from_map}, quota);
      }
    }
  };
  fill();
  if (slots_.size() < kLeastLeft && !occluders_.empty()) {
    DoubtOccluders();
    fill();
  }
}

// --- The patches of one image

void PatchPool::BeginImage(const Eigen::Vector3d& eye) {
  ++image_;
  if (occluders_.empty()) {
    return;
  }
  size_t left = 0;
  for (Slot& slot : slots_) {
    if ((slot.patch.point + image_) % kHideInterval == 0) {
      slot.occluder = HiddenBy(slot.patch.point_in_map, eye);
    }
    slot.hidden =
        slot.occluder != OccluderSet::kNone && occluders_.believed(slot.occluder) && !slot.trial;
    left += slot.hidden ? 0 : 1;
  }
  if (left < std::min(kLeastLeft, slots_.size())) {
    DoubtOccluders();
  }
}

void PatchPool::EndImage(const ExposedCamera& camera, std::span<const uint32_t> agreeing) {
  const Rigid3& pose = camera.camera_from_map;
  for (Slot& slot : slots_) {
    ++slot.failures;
  }
  for (const uint32_t i : agreeing) {
    slots_[i].failures = 0;
  }
  SettleHidden(camera);
  for (size_t i = slots_.size(); i-- > 0;) {
    Slot& slot = slots_[i];
    const auto pixel = camera.model.Project(pose * slot.patch.point_in_map);
    if (!pixel || !camera.model.Contains(*pixel)) {
      RemoveSlot(i, 0);
    } else if (slot.failures >= kMostFailures || ((slot.patch.point + image_) % kAimInterval == 0 &&
                                                  !source_.ChooseKeyframe(pose, slot.patch))) {
      RemoveSlot(i, kRestFailed);
    }
  }
  CountCells(camera.model, pose);
  if (next_near_ >= near_count_) {
    RankKeyframes(pose);
    next_near_ = 0;
  }
  if (near_count_ > 0 && slots_.size() < kMostPatches) {
    AddFrom(near_[next_near_++], camera, slots_.size() < kMostPatches / 2 ? 2 : 1);
  }
}

// --- Occluders

uint32_t PatchPool::HiddenBy(const Eigen::Vector3d& point, const Eigen::Vector3d& eye) const {
  if (occluders_.empty()) {
    return OccluderSet::kNone;
  }
  return occluders_.HiddenBy(eye, point, kHidingBias * std::max((point - eye).norm(), scale_));
}

// Tells the occluders whether the points behind them were found. Each slot counts once, because
// slots that are found stay and would outvote the others.
void PatchPool::SettleHidden(const ExposedCamera& camera) {
  for (size_t i = slots_.size(); i-- > 0;) {
    Slot& slot = slots_[i];
    if (slot.occluder == OccluderSet::kNone) {
      continue;
    }
    PatchView view;
    if (!slot.hidden && !slot.noted && source_.View(camera, slot.patch, view)) {
      occluders_.Note(slot.occluder, slot.failures == 0);
      slot.noted = true;
    }
    if (slot.hidden || slot.trial) {
      RemoveSlot(i, kRestHidden);
    }
  }
}

// Withdraws trust from the occluders and makes the hidden points available again.
void PatchPool::DoubtOccluders() {
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

uint32_t PatchPool::LeastUsedFresh() const {
  std::array<size_t, PatchSource::kFreshImages> uses{};
  for (const Slot& slot : slots_) {
    if (slot.patch.source >= PatchSource::kFresh) {
      ++uses[slot.patch.source - PatchSource::kFresh];
    }
  }
  return static_cast<uint32_t>(std::min_element(uses.begin(), uses.end()) - uses.begin());
}

// Returns whether a keyframe's patch matches the image at the position of the detected feature.
bool PatchPool::ShowsKeyframePatch(const ExposedCamera& camera,
                                   const ImagePyramid& image,
                                   const LocatedPoint& located,
                                   SourcePatch& patch) const {
  PatchView view;
  PatchTemplate sampled;
  PatchFit fit;
  return source_.ChooseKeyframe(camera.camera_from_map, patch) &&
         source_.Sample(camera, patch, 0, view, sampled) &&
         AlignPatch(image.level(0), sampled, view.pixel.cast<float>(), {}, fit) &&
         fit.correlation >= kLeastCorrelation &&
         (fit.centre - located.pixel).norm() < 1.0f + 3.0f * located.sigma_px;
}

void PatchPool::Merge(ImagePyramid& image,
                      const CameraModel& camera,
                      const Rigid3& camera_from_map,
                      std::span<const LocatedPoint> points,
                      const Rigid3& camera_from_map_now) {
  for (size_t i = slots_.size(); i-- > 0;) {
    if (slots_[i].failures > 0) {
      RemoveSlot(i, kRestFailed);
    }
  }
  CountCells(camera, camera_from_map_now);
  const int quota = slots_.size() < kMostPatches / 2 ? 2 : 1;
  const Eigen::Vector3d eye = camera_from_map_now.Center();
  // Patches from the image itself already contain its blur.
  const ExposedCamera sharp{camera, camera_from_map};
  const ImagePyramid* shown = &image;
  std::optional<uint32_t> fresh;  // The fresh image that this call uses.
  for (const LocatedPoint& located : points) {
    if (slots_.size() >= kMostPatches) {
      break;
    }
    Slot slot{.patch = source_.PatchOf(located.point)};
    const auto pixel = camera.Project(camera_from_map_now * slot.patch.point_in_map);
    if (not_before_[located.point] == kUsed || !pixel || !HasRoomForPatch(camera, *pixel)) {
      continue;
    }
    const auto cell = static_cast<size_t>(CellIn(camera, *pixel, kColumns, kRows));
    if (cell_counts_[cell] >= quota) {
      continue;
    }
    slot.occluder = HiddenBy(slot.patch.point_in_map, eye);
    if (slot.occluder != OccluderSet::kNone && occluders_.believed(slot.occluder)) {
      continue;
    }
    if (!ShowsKeyframePatch(sharp, *shown, located, slot.patch)) {
      if (!fresh) {
        fresh = LeastUsedFresh();
        for (size_t i = slots_.size(); i-- > 0;) {
          if (slots_[i].patch.source == PatchSource::kFresh + *fresh) {
            RemoveSlot(i, 0);
          }
        }
        source_.SwapFresh(*fresh, image, camera, camera_from_map);
        shown = &source_.fresh(*fresh);
      }
      PatchView view;
      PatchTemplate sampled;
      if (!source_.ChooseFresh(*fresh, located, slot.patch) ||
          !source_.Sample(sharp, slot.patch, 0, view, sampled)) {
        continue;
      }
    }
    not_before_[located.point] = kUsed;
    slots_.push_back(slot);
    ++cell_counts_[cell];
  }
}

// --- Choosing patches

void PatchPool::RankKeyframes(const Rigid3& camera_from_map) {
  const SceneDatabase& db = database();
  std::array<double, kNearKeyframes> scores;
  near_count_ = 0;
  const Eigen::Vector3d centre = camera_from_map.Center();
  const Eigen::Vector3d axis = camera_from_map.rotation.conjugate() * Eigen::Vector3d::UnitZ();
  for (uint32_t k = 0; k < db.keyframes.size(); ++k) {
    const double depth = source_.map().median_depth(k);
    if (depth <= 0.0 || source_.map().pyramid(k).levels() == 0) {
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

void PatchPool::CountCells(const CameraModel& camera, const Rigid3& camera_from_map) {
  cell_counts_.fill(0);
  for (const Slot& slot : slots_) {
    const auto pixel = camera.Project(camera_from_map * slot.patch.point_in_map);
    if (pixel && camera.Contains(*pixel)) {
      ++cell_counts_[static_cast<size_t>(CellIn(camera, *pixel, kColumns, kRows))];
    }
  }
}

bool PatchPool::AddSlot(uint32_t point,
                        const ExposedCamera& camera,
                        uint32_t occluder,
                        bool trial) {
  Slot slot{.patch = source_.PatchOf(point), .occluder = occluder, .trial = trial};
  PatchView view;
  PatchTemplate sampled;
  if (!source_.ChooseKeyframe(camera.camera_from_map, slot.patch) ||
      !source_.Sample(camera, slot.patch, 0, view, sampled)) {
    not_before_[point] = image_ + kRestUseless;
    return false;
  }
  not_before_[point] = kUsed;
  slots_.push_back(slot);
  return true;
}

// Adds at most one point of the keyframe to each cell that holds fewer than quota.
void PatchPool::AddFrom(uint32_t keyframe, const ExposedCamera& exposed, int quota) {
  struct Candidate {
    uint32_t point = kUsed;
    float merit = -std::numeric_limits<float>::infinity();
    uint32_t occluder = OccluderSet::kNone;
  };
  std::array<Candidate, kCells> best;
  std::array<Candidate, kTrials> trials;
  size_t trial_count = 0;
  const CameraModel& camera = exposed.model;
  const Rigid3& camera_from_map = exposed.camera_from_map;
  const Eigen::Vector3d eye = camera_from_map.Center();
  const SceneDatabase& db = database();
  const Eigen::Matrix3f rotation = camera_from_map.rotation.toRotationMatrix().cast<float>();
  const Eigen::Vector3f translation = camera_from_map.translation.cast<float>();
  const auto fx = static_cast<float>(camera.fx);
  const auto fy = static_cast<float>(camera.fy);
  const auto cx = static_cast<float>(camera.cx);
  const auto cy = static_cast<float>(camera.cy);
  for (const Observation& o : source_.map().ObservationsIn(keyframe)) {
    if (not_before_[o.point] > image_) {
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
    if (!HasRoomForPatch(camera, pixel)) {
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
      not_before_[o.point] = image_ + kRestHidden;
      if (trial_count < kTrials && HashedShare(o.point, image_) < kTried) {
        trials[trial_count++] = {o.point, merit, occluder};
      }
      continue;
    }
    best[cell] = {o.point, merit, occluder};
  }
  for (size_t cell = 0; cell < kCells && slots_.size() < kMostPatches; ++cell) {
    const Candidate& c = best[cell];
    if (c.point != kUsed && AddSlot(c.point, exposed, c.occluder, false)) {
      ++cell_counts_[cell];
    }
  }
  for (size_t i = 0; i < trial_count && slots_.size() < kMostPatches; ++i) {
    AddSlot(trials[i].point, exposed, trials[i].occluder, true);
  }
}

void PatchPool::RemoveSlot(size_t index, uint32_t rest) {
  not_before_[slots_[index].patch.point] = image_ + rest;
  slots_[index] = slots_.back();
  slots_.pop_back();
}

}  // namespace lararium::vision
