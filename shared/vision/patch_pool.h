#pragma once

// The patches that are searched for in every image: chooses them, so that they cover the image, and
// drops those that are not found or that an occluder hides.

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "shared/geometry/camera_model.h"
#include "shared/geometry/transform.h"
#include "shared/vision/occluders.h"
#include "shared/vision/patch_source.h"

namespace lararium::vision {

// Index of the cell that holds a pixel, in an image divided into columns and rows.
int CellIn(const geometry::CameraModel& camera,
           const Eigen::Vector2d& pixel,
           int columns,
           int rows);

// Allocates nothing in steady state.
class PatchPool {
 public:
  static constexpr size_t kMostPatches = 300;

  explicit PatchPool(std::shared_ptr<const TrackedMap> map);

  // See PatchTracker::SetOccluders.
  void SetOccluders(std::span<const OccluderMesh> meshes);

  // Discards all patches and chooses new ones for a pose that was found without a prior.
  void Start(const geometry::CameraModel& camera, const geometry::Rigid3& camera_from_map);

  // Begins an image that the camera took from about this position, map frame.
  void BeginImage(const Eigen::Vector3d& eye);
  // Ends the image: drops patches and adds others. agreeing: indices of the patches that agree with
  // the pose. All indices change.
  void EndImage(const ExposedCamera& camera, std::span<const uint32_t> agreeing);

  // See PatchTracker::Merge.
  void Merge(ImagePyramid& image,
             const geometry::CameraModel& camera,
             const geometry::Rigid3& camera_from_map,
             std::span<const LocatedPoint> points,
             const geometry::Rigid3& camera_from_map_now);

  uint32_t image() const { return image_; }  // Number of the current image.
  size_t size() const { return slots_.size(); }
  const SourcePatch& operator[](size_t i) const { return slots_[i].patch; }

  // See PatchSource. Both return false also for patch i if an occluder hides it.
  bool View(const ExposedCamera& camera, size_t i, PatchView& view) const {
    return !slots_[i].hidden && source_.View(camera, slots_[i].patch, view);
  }
  bool Sample(const ExposedCamera& camera,
              size_t i,
              int level,
              PatchView& view,
              PatchTemplate& sampled) const {
    return !slots_[i].hidden && source_.Sample(camera, slots_[i].patch, level, view, sampled);
  }

 private:
  struct Slot {
    SourcePatch patch;
    int failures = 0;                        // Number of images in a row without agreement.
    uint32_t occluder = OccluderSet::kNone;  // Occluder that hides the point.
    bool hidden = false;  // The occluder is trusted, so the patch is not searched for.
    bool trial = false;   // The patch is searched for in one image to test the occluder.
    bool noted = false;   // The occluder has been told whether the patch was found.
  };

  static constexpr int kColumns = 20;
  static constexpr int kRows = 15;
  static constexpr int kCells = kColumns * kRows;
  static constexpr size_t kNearKeyframes = 6;

  const SceneDatabase& database() const { return source_.map().database(); }

  // Choosing patches.
  void RankKeyframes(const geometry::Rigid3& camera_from_map);
  void CountCells(const geometry::CameraModel& camera, const geometry::Rigid3& camera_from_map);
  void AddFrom(uint32_t keyframe, const ExposedCamera& exposed, int quota);
  bool AddSlot(uint32_t point, const ExposedCamera& camera, uint32_t occluder, bool trial);
  void RemoveSlot(size_t index, uint32_t rest);

  // Occluders.
  uint32_t HiddenBy(const Eigen::Vector3d& point, const Eigen::Vector3d& eye) const;
  void SettleHidden(const ExposedCamera& camera);
  void DoubtOccluders();

  // Fresh patches.
  bool ShowsKeyframePatch(const ExposedCamera& camera,
                          const ImagePyramid& image,
                          const LocatedPoint& located,
                          SourcePatch& patch) const;
  uint32_t LeastUsedFresh() const;

  PatchSource source_;
  OccluderSet occluders_;
  double scale_ = 0.0;  // Mean of the keyframes' median depths, map units.
  uint32_t image_ = 0;
  std::vector<Slot> slots_;
  // [points]: Image number from which the point may be chosen, or kUsed while it has a slot.
  std::vector<uint32_t> not_before_;
  std::array<uint8_t, kCells> cell_counts_{};
  std::array<uint32_t, kNearKeyframes> near_{};
  size_t near_count_ = 0;
  size_t next_near_ = 0;
};

}  // namespace lararium::vision
