#pragma once

// Tracks the camera from frame to frame without detecting features. Patches around map points are
// warped from the keyframes with the most similar view and aligned with the image from coarse to
// fine. The keyframes never change, so the pose does not drift.

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "shared/geometry/camera_model.h"
#include "shared/geometry/transform.h"
#include "shared/vision/confidence.h"
#include "shared/vision/follow_map.h"
#include "shared/vision/image_pyramid.h"
#include "shared/vision/localizer.h"
#include "shared/vision/occluders.h"
#include "shared/vision/patch.h"
#include "shared/vision/patch_pose.h"

namespace lararium::vision {

// The pose that the patches agree on.
struct FollowedPose {
  // Enough of the expected patches agree, they are spread over the image, and the error is small.
  bool honest = false;
  geometry::Rigid3 camera_from_map;
  PoseEvidence evidence;
  int expected = 0;  // Number of patches that should be visible.
  int agreeing = 0;  // Number of patches that agree with the pose.
  // Expected registration error of the pose, one sigma, root mean square over the image.
  double expected_error_px = 0.0;
  double blur_px = 0.0;  // Mean path of the patches in the image during the exposure.
  double share() const { return expected > 0 ? static_cast<double>(agreeing) / expected : 0.0; }
};

// Allocates nothing in steady state.
class PatchTracker {
 public:
  explicit PatchTracker(std::shared_ptr<const TrackedMap> map);

  // Replaces the objects that hide map points. Points behind an occluder are not searched for while
  // it is trusted. It is trusted after points behind it were not found, and never if hardly any
  // patch would be left.
  void SetOccluders(std::span<const OccluderMesh> meshes);

  // Discards all patches and chooses new ones for a pose that was found without a prior. camera
  // describes the images to come.
  void Start(const geometry::CameraModel& camera, const geometry::Rigid3& camera_from_map);

  // Finds the pose of an image near one of the predictions. before is the pose of the previous
  // image, `frames` frames ago, or nullptr if it is unknown. The set of patches changes only if the
  // pose is honest.
  FollowedPose Follow(const ImagePyramid& image,
                      const geometry::CameraModel& camera,
                      std::span<const geometry::Rigid3> predictions,
                      const geometry::Rigid3* before,
                      double frames);

  // Adds points that the relocaliser found in a recent image with a known pose, in image cells that
  // hold few patches. A point gets a keyframe's patch if that matches the image, otherwise a patch
  // from the image itself. Such a fresh patch is centred on the detected feature. Its error does
  // not depend on the pose, so the pose does not drift. points must be ordered from most to least
  // accurate. image may be swapped for another one.
  void Merge(ImagePyramid& image,
             const geometry::CameraModel& camera,
             const geometry::Rigid3& camera_from_map,
             std::span<const LocatedPoint> points,
             const geometry::Rigid3& camera_from_map_now);

  // The points that agree with the last honest pose.
  std::span<const SeenPoint> seen() const { return seen_; }

  // See TrackedFrame::shutter.
  std::optional<float> shutter() const {
    constexpr int kEnoughTrials = 3;
    return shutter_trials_ < kEnoughTrials ? std::nullopt
                                           : std::optional(static_cast<float>(shutter_));
  }

 private:
  // A patch that is searched for in every frame.
  struct Slot {
    uint32_t point = 0;
    // Index of the keyframe whose image holds the patch; kFresh + i for fresh_[i].
    uint32_t keyframe = 0;
    // Standard deviation, along one axis, of the point's position within the patch.
    float sigma_px = 0.0f;
    Eigen::Vector3d point_in_map = Eigen::Vector3d::Zero();
    // Position of the point in the keyframe, on the plane z = 1 and as a raw pixel.
    Eigen::Vector2d key_plane = Eigen::Vector2d::Zero();
    Eigen::Vector2d key_pixel = Eigen::Vector2d::Zero();
    Eigen::Vector3d tangent = Eigen::Vector3d::Zero();  // See TrackedMap::PlaneAt.
    Eigen::Matrix2d plane_from_key_pixel = Eigen::Matrix2d::Zero();
    int failures = 0;                        // Number of frames in a row without agreement.
    uint32_t occluder = OccluderSet::kNone;  // Occluder that hides the point.
    bool hidden = false;  // The occluder is trusted, so the patch is not searched for.
    bool trial = false;   // The patch is searched for in one frame to test the occluder.
    bool noted = false;   // The occluder has been told whether the patch was found.
  };

  // The position of a slot's patch in one frame.
  struct PatchObservation {
    uint32_t slot = 0;
    Eigen::Vector2f pixel = Eigen::Vector2f::Zero();  // raw pixel
  };

  // The observations on one pyramid level and the pose that explains them. Entry i of each list
  // belongs to the same observation.
  struct Fit {
    std::vector<PatchObservation> observations;
    std::vector<PatchMatch> matches;
    PatchPose pose;

    void Clear();
  };

  // An image that supplies patches where those of the keyframes do not match.
  struct FreshFrame {
    ImagePyramid image;
    geometry::CameraModel camera;
    geometry::Rigid3 camera_from_map;
  };

  // The expected position of a slot in the image, and the warp of its patch from the keyframe.
  struct View {
    Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
    Eigen::Matrix2d key_from_pixel = Eigen::Matrix2d::Zero();
    // Motion in the image during the exposure, pixels; see PatchMotion.
    Eigen::Vector2d velocity = Eigen::Vector2d::Zero();
    Eigen::Vector2d acceleration = Eigen::Vector2d::Zero();
  };

  bool ViewSlot(const geometry::CameraModel& camera,
                const geometry::Rigid3& camera_from_map,
                const Slot& slot,
                View& view) const;
  bool SampleSlot(const Slot& slot, const View& view, int level, PatchTemplate& patch) const;
  // Aligns every stride-th slot on a level and updates the pose. expected becomes the number of
  // patches that should be visible.
  bool RunLevel(const ImagePyramid& image,
                const geometry::CameraModel& camera,
                int level,
                int stride,
                geometry::Rigid3& camera_from_map,
                int& expected);
  // Exhaustive search in whole pixels on the coarsest level, for use when alignment failed. Returns
  // false and changes nothing unless more than `least` patches agree with the new pose.
  bool SearchLevel(const ImagePyramid& image,
                   const geometry::CameraModel& camera,
                   int level,
                   int stride,
                   int least,
                   geometry::Rigid3& camera_from_map);
  void AddObservation(const geometry::CameraModel& camera,
                      uint32_t slot,
                      int level,
                      const PatchFit& patch,
                      Fit& fit) const;
  geometry::Rigid3 BestPrediction(const ImagePyramid& image,
                                  const geometry::CameraModel& camera,
                                  std::span<const geometry::Rigid3> predictions);
  double BlurPx(const geometry::CameraModel& camera, const geometry::Rigid3& camera_from_map) const;
  double Likeness(const ImagePyramid& image,
                  const geometry::CameraModel& camera,
                  int level,
                  const geometry::Rigid3& camera_from_map,
                  double shutter);
  Matrix6d Accelerations() const;
  Matrix6d Covariance() const;
  void EstimateShutter(const ImagePyramid& image,
                       const geometry::CameraModel& camera,
                       int level,
                       const geometry::Rigid3& camera_from_map);
  int FinestLevel(const geometry::CameraModel& camera,
                  const geometry::Rigid3& camera_from_map) const;
  void SetMotion(const geometry::Rigid3& camera_from_map);

  void Judge(const geometry::CameraModel& camera, FollowedPose& pose);
  void Settle(const geometry::CameraModel& camera, const FollowedPose& pose);

  // Choosing patches.
  static float Unlike(const geometry::Rigid3& key_from_map,
                      const Eigen::Vector3d& point,
                      const geometry::Rigid3& camera_from_map);
  uint32_t LeastUnlike(uint32_t point, const geometry::Rigid3& camera_from_map, float most) const;
  bool AimSlot(Slot& slot, const geometry::Rigid3& camera_from_map);
  void RankKeyframes(const geometry::Rigid3& camera_from_map);
  void AddFrom(uint32_t keyframe,
               const geometry::CameraModel& camera,
               const geometry::Rigid3& camera_from_map,
               int quota);
  void CountCells(const geometry::CameraModel& camera, const geometry::Rigid3& camera_from_map);
  void RemoveSlot(size_t index, uint32_t rest);
  bool AddSlot(uint32_t point,
               const geometry::CameraModel& camera,
               const geometry::Rigid3& camera_from_map,
               uint32_t occluder,
               bool trial);

  // Occluders.
  uint32_t HiddenBy(const Eigen::Vector3d& point, const Eigen::Vector3d& eye) const;
  void HideSlots(const Eigen::Vector3d& eye);
  void SettleHidden(const geometry::CameraModel& camera, const geometry::Rigid3& camera_from_map);
  void DoubtOccluders();

  // Fresh patches.
  bool ShowsKeyframePatch(Slot& slot,
                          const ImagePyramid& image,
                          const geometry::CameraModel& camera,
                          const geometry::Rigid3& camera_from_map,
                          const LocatedPoint& seen);
  bool AimAtFresh(Slot& slot, uint32_t fresh, const LocatedPoint& seen);
  uint32_t LeastUsedFresh() const;
  const ImagePyramid& ImageOf(const Slot& slot) const;
  const geometry::Rigid3& PoseOf(const Slot& slot) const;

  static constexpr int kColumns = 20;
  static constexpr int kRows = 15;
  static constexpr int kCells = kColumns * kRows;
  static constexpr size_t kMostSlots = 300;
  static constexpr size_t kNearKeyframes = 6;
  static constexpr uint32_t kFreshFrames = 3;
  static constexpr uint32_t kFresh = 0x80000000;

  std::shared_ptr<const TrackedMap> map_;
  OccluderSet occluders_;
  double scale_ = 0.0;  // Mean of the keyframes' median depths, map units.
  std::array<FreshFrame, kFreshFrames> fresh_;
  uint32_t now_ = 0;  // Number of the current frame.
  std::vector<Slot> slots_;
  // [points]: Frame number from which the point may be chosen, or kUsed while it has a slot.
  std::vector<uint32_t> not_before_;
  std::array<uint8_t, kCells> cell_counts_{};
  std::array<uint32_t, kNearKeyframes> near_{};
  size_t near_count_ = 0;
  size_t next_near_ = 0;

  // Motion model for blur: the motion of the camera during one frame, and the share of the frame
  // time for which the shutter is open.
  bool has_motion_ = false;
  geometry::Rigid3 before_;
  double frames_ = 1.0;
  // Camera motions (w, v) per frame: from the frame before to this one, and the motion before that.
  Vector6d motion_ = Vector6d::Zero();
  Vector6d motion_before_ = Vector6d::Zero();
  bool has_motion_before_ = false;
  // Displacements by the velocity and by the acceleration over one frame.
  geometry::Rigid3 velocity_;
  geometry::Rigid3 acceleration_;
  Matrix6d accelerations_ = Matrix6d::Zero();  // Running mean square of the acceleration.
  bool knows_accelerations_ = false;
  double shutter_ = 0.3;
  int shutter_trials_ = 0;

  // Working memory.
  Fit fit_;  // Supports the current pose.
  Fit searched_;
  std::vector<SeenPoint> seen_;
  std::vector<double> depths_;
};

}  // namespace lararium::vision
