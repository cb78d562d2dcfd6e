#pragma once

// The images that supply patches: the keyframes of a map, and a few recent images of the camera.

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>

#include "shared/geometry/camera_model.h"
#include "shared/geometry/transform.h"
#include "shared/vision/exposure_model.h"
#include "shared/vision/follow_map.h"
#include "shared/vision/image_pyramid.h"
#include "shared/vision/localizer.h"
#include "shared/vision/patch.h"

namespace lararium::vision {

inline constexpr float kLeastCorrelation = 0.7f;  // Lowest correlation that counts as a match.

// Returns whether a raw pixel is far enough from the image border for a patch.
bool HasRoomForPatch(const geometry::CameraModel& camera, const Eigen::Vector2d& pixel);

// The camera at the time of one image. Refers to values that its user owns.
struct ExposedCamera {
  const geometry::CameraModel& model;
  const geometry::Rigid3& camera_from_map;
  const ExposureMotion* motion = nullptr;  // nullptr: patches are not blurred.
  // See CameraEstimate::readout. Without a motion it has no effect.
  Eigen::Vector2d readout = Eigen::Vector2d::Zero();
};

// The patch around a map point in the image that supplies it.
struct SourcePatch {
  uint32_t point = 0;
  uint32_t source = 0;  // Index of a keyframe; PatchSource::kFresh + i for fresh image i.
  // Pose of the source when it saw the point.
  geometry::Rigid3 source_from_map;
  // Standard deviation, along one axis, of the point's position within the patch.
  float sigma_px = 0.0f;
  Eigen::Vector3d point_in_map = Eigen::Vector3d::Zero();
  // Position of the point in the source, on the plane z = 1 and as a raw pixel.
  Eigen::Vector2d key_plane = Eigen::Vector2d::Zero();
  Eigen::Vector2d key_pixel = Eigen::Vector2d::Zero();
  // Tangent plane in the source's camera frame, see TrackedMap::PlaneAt.
  Eigen::Vector3d tangent = Eigen::Vector3d::Zero();
  Eigen::Matrix2d plane_from_key_pixel = Eigen::Matrix2d::Zero();
};

// The expected position of a patch in an image, and its warp from the source.
struct PatchView {
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();  // Raw pixel of the image.
  Eigen::Matrix2d key_from_pixel = Eigen::Matrix2d::Zero();
  // Motion in the image during the exposure, pixels; see PatchMotion.
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();
  Eigen::Vector2d acceleration = Eigen::Vector2d::Zero();
};

class PatchSource {
 public:
  static constexpr uint32_t kFresh = 0x80000000;
  static constexpr uint32_t kFreshImages = 3;

  explicit PatchSource(std::shared_ptr<const TrackedMap> map) : map_(std::move(map)) {}

  const TrackedMap& map() const { return *map_; }

  // The patch of a point, for which no source has been chosen yet.
  SourcePatch PatchOf(uint32_t point) const;
  // Chooses the keyframe with the view that is most similar to the camera's. A patch from a fresh
  // image is kept as long as its view is similar enough. Returns false if no source is suitable.
  bool ChooseKeyframe(const geometry::Rigid3& camera_from_map, SourcePatch& patch) const;
  // Takes the patch from fresh image i, centred on the detected feature. The tangent plane is that
  // of the keyframe with the most similar view. Returns false if the image is not suitable.
  bool ChooseFresh(uint32_t i, const LocatedPoint& located, SourcePatch& patch) const;

  // Allocates the memory of the fresh images, if that has not been done.
  void AllocateFresh(const geometry::CameraModel& camera);
  // Replaces fresh image i and gives its former memory to image.
  void SwapFresh(uint32_t i,
                 ImagePyramid& image,
                 const geometry::CameraModel& camera,
                 const geometry::Rigid3& camera_from_map);
  const ImagePyramid& fresh(uint32_t i) const { return fresh_[i].image; }

  // Computes where and how the camera shows the patch. Returns false if it does not show it, or
  // from behind, edge-on, or much larger than the source.
  bool View(const ExposedCamera& camera, const SourcePatch& patch, PatchView& view) const;
  // Computes the view, and the patch as the camera shows it on a pyramid level. Returns false if
  // there is no view or the patch is not usable.
  bool Sample(const ExposedCamera& camera,
              const SourcePatch& patch,
              int level,
              PatchView& view,
              PatchTemplate& sampled) const;

 private:
  // A recent image that supplies patches where those of the keyframes do not match.
  struct FreshImage {
    ImagePyramid image;
    geometry::CameraModel camera;
    geometry::Rigid3 camera_from_map;
  };

  const ImagePyramid& ImageOf(const SourcePatch& patch) const;
  std::optional<uint32_t> MostSimilarKeyframe(uint32_t point,
                                              const geometry::Rigid3& camera_from_map,
                                              float most) const;

  std::shared_ptr<const TrackedMap> map_;
  std::array<FreshImage, kFreshImages> fresh_;
};

// A pseudo-random number in 0..1 that depends on both arguments only.
float HashedShare(uint32_t a, uint32_t b);

}  // namespace lararium::vision
