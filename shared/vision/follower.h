#pragma once

// Follows a place from frame to frame without detecting features: patches of map
// points, warped from the keyframes that saw them most alike, are aligned with the
// image from coarse to fine. The keyframes never change, so nothing drifts.

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

// A pose that patches agree on.
struct FollowedPose {
  bool honest = false;  // enough of what should be seen is seen, all over the image
  geometry::Rigid3 camera_from_map;
  PoseEvidence evidence;
  int expected = 0;  // patches that should be seen
  int agreeing = 0;  // that are seen where the pose puts them
  // One sigma of where the pose puts what is visible, root mean square over the image.
  double expected_error_px = 0.0;
  double blur_px = 0.0;  // mean path of what is visible during the exposure
  double share() const { return expected > 0 ? static_cast<double>(agreeing) / expected : 0.0; }
};

// Allocates nothing between constructions, however long it runs.
class Follower {
 public:
  explicit Follower(std::shared_ptr<const FollowMap> map);

  // Things of the map that hide its points from now on. Points behind one are not
  // looked for while it is believed; it is from when what it hides was not seen, and
  // never where nearly nothing would be left.
  void SetOccluders(std::span<const OccluderMesh> meshes);

  // Chooses patches anew for a pose that was found without a prior. camera: of the
  // images to come.
  void Start(const geometry::CameraModel& camera, const geometry::Rigid3& camera_from_map);

  // Finds the pose of an image near one of the predictions. before: the pose of the
  // image before, frames ago; nullptr where none is known. Changes which patches are
  // looked for next only if the pose is honest.
  FollowedPose Follow(const ImagePyramid& image,
                      const geometry::CameraModel& camera,
                      std::span<const geometry::Rigid3> predictions,
                      const geometry::Rigid3* before,
                      double frames);

  // Takes up points that the detector saw in an image of late, whose pose is known,
  // where few patches are followed now: a keyframe's patch where the image shows
  // that, otherwise the image's own. That one stays where the detector saw the
  // point; its error is its own and does not depend on the pose, so nothing drifts.
  // points: the most exact first. image: may be exchanged for another one.
  void Merge(ImagePyramid& image,
             const geometry::CameraModel& camera,
             const geometry::Rigid3& camera_from_map,
             std::span<const LocatedPoint> points,
             const geometry::Rigid3& camera_from_map_now);

  // Of the last honest pose.
  std::span<const SeenPoint> seen() const { return seen_; }

  // TrackedFrame::shutter: none while too little fast motion was seen.
  std::optional<float> shutter() const {
    constexpr int kEnoughTrials = 3;
    return shutter_trials_ < kEnoughTrials ? std::nullopt
                                           : std::optional(static_cast<float>(shutter_));
  }

 private:
  // A patch that is looked for in every frame.
  struct Slot {
    uint32_t point = 0;
    uint32_t keyframe = 0;  // kFresh and more: of fresh_
    float sigma_px = 0.0f;  // of where the patch lies around the point, along one axis
    Eigen::Vector3d point_in_map = Eigen::Vector3d::Zero();
    Eigen::Vector2d key_plane = Eigen::Vector2d::Zero();  // of the point, on z = 1
    Eigen::Vector2d key_pixel = Eigen::Vector2d::Zero();  // raw
    Eigen::Vector3d tangent = Eigen::Vector3d::Zero();    // FollowMap::PlaneAt
    Eigen::Matrix2d plane_from_key_pixel = Eigen::Matrix2d::Zero();
    int failures = 0;                        // in a row
    uint32_t occluder = OccluderSet::kNone;  // that hides it, of late
    bool hidden = false;                     // and is believed: not looked for
    bool trial = false;                      // looked for once nevertheless
    bool noted = false;                      // told the occluder whether it was seen
  };

  struct Sight {  // of a slot, in one frame
    uint32_t slot = 0;
    Eigen::Vector2f pixel = Eigen::Vector2f::Zero();  // raw
  };

  // What was seen on a level, and the pose that it makes. Entry i of each list is of
  // the same sight.
  struct Fit {
    std::vector<Sight> sights;
    std::vector<PatchMatch> matches;
    PatchPose pose;

    void Clear();
  };

  // An image whose patches are followed where no keyframe's serve.
  struct FreshFrame {
    ImagePyramid image;
    geometry::CameraModel camera;
    geometry::Rigid3 camera_from_map;
  };

  // Where a slot is expected, and how its patch lies in its keyframe.
  struct View {
    Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
    Eigen::Matrix2d key_from_pixel = Eigen::Matrix2d::Zero();
    // During the exposure, pixels.
    Eigen::Vector2d velocity = Eigen::Vector2d::Zero();
    Eigen::Vector2d acceleration = Eigen::Vector2d::Zero();
  };

  bool ViewSlot(const geometry::CameraModel& camera,
                const geometry::Rigid3& camera_from_map,
                const Slot& slot,
                View& view) const;
  bool SampleSlot(const Slot& slot, const View& view, int level, PatchTemplate& patch) const;
  // Aligns every stride-th slot on a level and moves the pose. Counts in expected
  // what should be seen.
  bool RunLevel(const ImagePyramid& image,
                const geometry::CameraModel& camera,
                int level,
                int stride,
                geometry::Rigid3& camera_from_map,
                int& expected);
  // Looks for whole pixels around, on the coarsest level, where alignment failed. false: it
  // made no pose that more than least agree with, and changed nothing.
  bool SearchLevel(const ImagePyramid& image,
                   const geometry::CameraModel& camera,
                   int level,
                   int stride,
                   int least,
                   geometry::Rigid3& camera_from_map);
  void AddSight(const geometry::CameraModel& camera,
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

  std::shared_ptr<const FollowMap> map_;
  OccluderSet occluders_;
  double scale_ = 0.0;  // of the map: the distance from which it was filmed, map units
  std::array<FreshFrame, kFreshFrames> fresh_;
  uint32_t now_ = 0;  // counts frames
  std::vector<Slot> slots_;
  std::vector<uint32_t> not_before_;  // [points]: now_ from which it may be chosen; kUsed: is
  std::array<uint8_t, kCells> cell_counts_{};
  std::array<uint32_t, kNearKeyframes> near_{};
  size_t near_count_ = 0;
  size_t next_near_ = 0;

  // Of the exposure: the motion of the camera during one frame, and the part of the
  // frame's time for which the shutter is open.
  bool has_motion_ = false;
  geometry::Rigid3 before_;
  double frames_ = 1.0;
  // Twists (w, v) of the camera: the motion from the frame before, and the one before
  // that, each frame.
  Vector6d motion_ = Vector6d::Zero();
  Vector6d motion_before_ = Vector6d::Zero();
  bool has_motion_before_ = false;
  geometry::Rigid3 velocity_;                  // what a frame's time of it does
  geometry::Rigid3 acceleration_;              // likewise
  Matrix6d accelerations_ = Matrix6d::Zero();  // mean square of late
  bool knows_accelerations_ = false;
  double shutter_ = 0.3;
  int shutter_trials_ = 0;

  // Working memory.
  Fit fit_;  // that the pose stands on
  Fit searched_;
  std::vector<SeenPoint> seen_;
  std::vector<double> depths_;
};

}  // namespace lararium::vision
