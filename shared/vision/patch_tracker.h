#pragma once

// Tracks the camera from frame to frame without detecting features. Patches around map points are
// warped from the keyframes with the most similar view and aligned with the image from coarse to
// fine. The keyframes never change, so the pose does not drift.

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "shared/geometry/camera_model.h"
#include "shared/geometry/transform.h"
#include "shared/vision/confidence.h"
#include "shared/vision/exposure_model.h"
#include "shared/vision/follow_map.h"
#include "shared/vision/image_pyramid.h"
#include "shared/vision/localizer.h"
#include "shared/vision/occluders.h"
#include "shared/vision/patch.h"
#include "shared/vision/patch_pool.h"
#include "shared/vision/patch_pose.h"
#include "shared/vision/tracked_frame.h"

namespace lararium::vision {

// The pose that the patches agree on.
struct FollowedPose {
  // Enough of the expected patches agree, they are spread over the image, and the error is small.
  bool reliable = false;
  geometry::Rigid3 camera_from_map;
  CameraEstimate camera;           // Estimated with the pose.
  std::optional<Vector6d> motion;  // (w, v) during one frame time, if it is known.
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
  void SetOccluders(std::span<const OccluderMesh> meshes) { pool_.SetOccluders(meshes); }

  // Discards all patches and chooses new ones for a pose that was found without a prior. camera
  // describes the images to come.
  void Start(const geometry::CameraModel& camera, const geometry::Rigid3& camera_from_map);

  // Finds the pose of an image near one of the predictions. before is the pose of the previous
  // image, `frames` frames ago, or nullptr if it is unknown. camera: what is known of the camera
  // before this image. The set of patches changes only if the pose is reliable.
  FollowedPose Follow(const ImagePyramid& image,
                      const CameraEstimate& camera,
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
             const geometry::Rigid3& camera_from_map_now) {
    pool_.Merge(image, camera, camera_from_map, points, camera_from_map_now);
  }

  // The camera that explains the patches of the last image, which was followed with a reliable
  // pose, if this is known of it before.
  CameraEstimate EstimateCamera(const CameraEstimate& prior);

  // The points that agree with the last reliable pose.
  std::span<const SeenPoint> seen() const { return seen_; }

  // See TrackedFrame::shutter.
  std::optional<float> shutter() const { return exposure_.shutter(); }

 private:
  // The position of a patch in one image.
  struct PatchObservation {
    uint32_t patch = 0;                               // Index into pool_.
    Eigen::Vector2f pixel = Eigen::Vector2f::Zero();  // raw pixel
  };

  // The observations on one pyramid level and the pose that explains them. Entry i of each list
  // belongs to the same observation.
  struct Fit {
    std::vector<PatchObservation> observations;
    std::vector<PatchMatch> matches;
    PatchPose pose;

    void Clear();
    bool Agrees(size_t i) const { return pose.squares[i] < kInlierSquare; }
  };

  // Aligns every stride-th patch on a level and updates the pose. expected becomes the number of
  // patches that should be visible.
  bool RunLevel(const ImagePyramid& image,
                const CameraPrior& prior,
                int level,
                int stride,
                PosedCamera& posed,
                int& expected);
  // Exhaustive search in whole pixels on the coarsest level, for use when alignment failed. Returns
  // false and changes nothing unless more than `least` patches agree with the new pose.
  bool SearchLevel(const ImagePyramid& image,
                   const CameraPrior& prior,
                   int level,
                   int stride,
                   int least,
                   PosedCamera& posed);
  void AddObservation(uint32_t patch, int level, const PatchFit& found, Fit& fit) const;
  ExposedCamera Exposed(const PosedCamera& posed) const {
    return {posed.camera.model, posed.camera_from_map, exposure_.motion(), posed.camera.readout};
  }
  geometry::Rigid3 BestPrediction(const ImagePyramid& image,
                                  const CameraEstimate& camera,
                                  std::span<const geometry::Rigid3> predictions);
  double BlurPx(const ExposedCamera& camera) const;
  double Likeness(const ImagePyramid& image, const ExposedCamera& camera, int level) const;
  void LearnShutter(const ImagePyramid& image, const ExposedCamera& camera, int level);
  int FinestLevel(const ExposedCamera& camera) const;
  CameraPrior PriorOf(const CameraEstimate& camera) const;
  JointMatrix<kMostJoint> Covariance() const;
  void Judge(const CameraEstimate& prior, FollowedPose& pose);
  void Settle(const PosedCamera& posed);

  PatchPool pool_;
  ExposureModel exposure_;

  // Working memory.
  Fit fit_;  // Supports the current pose.
  Fit searched_;
  std::vector<uint32_t> agreeing_;  // Indices into pool_.
  std::vector<SeenPoint> seen_;
  std::vector<double> depths_;
};

}  // namespace lararium::vision
