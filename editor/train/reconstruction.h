#pragma once

// The state of structure from motion: tracks, the points that are triangulated from them, and the
// poses of the images.

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "editor/train/tracks.h"
#include "editor/train/training_camera.h"
#include "shared/geometry/camera_model.h"
#include "shared/geometry/transform.h"

namespace lararium::train {

// See vision::RollingShutter::motion.
using ImageMotion = Eigen::Matrix<double, 6, 1>;

struct TriangulationOptions {
  double max_error_px = 4.0;
  double min_angle = 0.026;  // Minimum of a point's widest angle, radians (1.5 degrees).
};

class Reconstruction {
 public:
  // camera_of_image[image] is an index into cameras; empty if one camera took all images.
  // pixels[image][feature] are raw pixels. The elements of tracks are indices into them.
  Reconstruction(std::vector<TrainingCamera> cameras,
                 std::vector<uint32_t> camera_of_image,
                 std::vector<std::vector<Eigen::Vector2d>> pixels,
                 Tracks tracks);
  Reconstruction(const geometry::CameraModel& camera,
                 std::vector<std::vector<Eigen::Vector2d>> pixels,
                 Tracks tracks)
      : Reconstruction({{camera}}, {}, std::move(pixels), std::move(tracks)) {}

  std::span<const TrainingCamera> cameras() const { return cameras_; }
  size_t LensCount() const { return train::LensCount(cameras_); }
  uint32_t CameraOf(uint32_t image) const { return camera_of_image_[image]; }
  // The camera that took an image.
  const geometry::CameraModel& camera(uint32_t image) const {
    return cameras_[CameraOf(image)].model;
  }
  // The camera that took most of the located images; of equals, the first. Where autofocus moves,
  // the one with the mean focal length.
  uint32_t MainCamera() const;
  // The camera that took most of the located images.
  const geometry::CameraModel& camera() const { return cameras_[MainCamera()].model; }
  // Also sets the other cameras with the same lens.
  void SetCamera(uint32_t index, const geometry::CameraModel& camera);
  // Adds a camera of its own for an image that turned out not to be taken by its camera.
  void GiveOwnCamera(uint32_t image, const geometry::CameraModel& camera);
  // Gives each image a camera of its own with the lens of its camera, which autofocus may have
  // moved. times[image]: when the images of the film were taken, in frame times; ascending.
  void LetBreathe(std::vector<double> times);
  // Empty unless the images may breathe.
  const std::vector<double>& times() const { return times_; }
  // focal_ratios[image]: See TrainingCamera.
  void SetFocalRatios(std::span<const double> focal_ratios);
  // Goes back to cameras and images as they were given to the constructor.
  void SetCameras(std::vector<TrainingCamera> cameras, std::vector<uint32_t> camera_of_image);
  const std::vector<uint32_t>& camera_of_image() const { return camera_of_image_; }

  // The shutter of the camera: its readout time and, for each image, the motion meanwhile; see
  // vision::RollingShutter. A global shutter unless set.
  void SetShutter(const Eigen::Vector2d& readout, std::vector<ImageMotion> motions) {
    readout_ = readout;
    motions_ = std::move(motions);
  }
  void SetReadout(const Eigen::Vector2d& readout) { readout_ = readout; }
  const Eigen::Vector2d& readout() const { return readout_; }
  // Zero if it is not known.
  ImageMotion motion(uint32_t image) const {
    return motions_.empty() ? ImageMotion::Zero() : motions_[image];
  }

  size_t image_count() const { return pixels_.size(); }
  bool Located(uint32_t image) const { return camera_from_map_[image].has_value(); }
  const geometry::Rigid3& camera_from_map(uint32_t image) const { return *camera_from_map_[image]; }
  void Locate(uint32_t image, const geometry::Rigid3& camera_from_map) {
    camera_from_map_[image] = camera_from_map;
  }
  // Indices of the images with a pose, ascending.
  std::vector<uint32_t> LocatedImages() const;

  // A track element is identified by its index in Tracks::elements.
  const Tracks& tracks() const { return tracks_; }
  std::span<const uint32_t> ElementsOf(uint32_t image) const { return image_elements_[image]; }
  uint32_t TrackOf(uint32_t element) const { return element_track_[element]; }
  uint32_t ImageOf(uint32_t element) const { return tracks_.elements[element].image; }
  const Eigen::Vector2d& Pixel(uint32_t element) const {
    return pixels_[tracks_.elements[element].image][tracks_.elements[element].feature];
  }
  // Undistorted position on the plane z = 1.
  const Eigen::Vector2d& PlanePoint(uint32_t element) const { return plane_points_[element]; }
  // The image's pose when the element's pixel was exposed.
  geometry::Rigid3 PoseOf(uint32_t element) const;

  bool HasPoint(uint32_t track) const { return points_[track].has_value(); }
  std::vector<uint32_t> TracksWithPoints() const;  // Indices of tracks, ascending.
  const Eigen::Vector3d& Point(uint32_t track) const { return *points_[track]; }
  void MovePoint(uint32_t track, const Eigen::Vector3d& point) { points_[track] = point; }
  // Returns whether the element is an observation of its track's point and not an outlier.
  bool Observed(uint32_t element) const { return observed_[element] != 0; }
  std::vector<uint32_t> Observations(uint32_t track) const;
  size_t ObservationCount(uint32_t track) const;
  size_t PointCount() const;

  // Squared reprojection error in raw pixels; infinite behind the camera.
  double SquaredErrorPx(uint32_t element, const Eigen::Vector3d& point) const;

  // Triangulates the point of a track that has none, by consensus of the located images.
  bool Triangulate(uint32_t track, const TriangulationOptions& options);
  // Triangulates the point again from its observations, or drops it if that fails.
  void Reintersect(uint32_t track);
  // Turns every element in a located image that fits the point into an observation.
  void Complete(uint32_t track, double max_error_px);
  // Drops observations with too large an error, then the point if fewer than two observations are
  // left or their rays are too parallel. Returns the number of dropped observations.
  size_t Filter(uint32_t track, const TriangulationOptions& options);

  // Drops the point of a track if most of the track's elements do not fit it. Such an object moved
  // in the scene, and the elements that fit agree by chance.
  void DropIfMoving(uint32_t track);

  // Removes an image's pose and observations.
  void Unlocate(uint32_t image);
  // Changes the axes and the unit of the map.
  void Transform(const geometry::Similarity3& new_from_map);

 private:
  bool WideEnough(std::span<const uint32_t> elements,
                  const Eigen::Vector3d& point,
                  double min_angle) const;
  std::optional<Eigen::Vector3d> Intersect(std::span<const uint32_t> elements) const;
  std::vector<uint32_t> Fitting(std::span<const uint32_t> elements,
                                const Eigen::Vector3d& point,
                                double max_error_px) const;
  std::vector<uint32_t> BestConsensus(std::span<const uint32_t> elements,
                                      const TriangulationOptions& options) const;
  std::vector<uint32_t> LocatedElements(uint32_t track) const;
  void DropPoint(uint32_t track);
  void FillPlanePoints(uint32_t image);

  std::vector<TrainingCamera> cameras_;
  std::vector<uint32_t> camera_of_image_;
  Eigen::Vector2d readout_ = Eigen::Vector2d::Zero();
  std::vector<ImageMotion> motions_;  // [image], or empty
  std::vector<double> times_;
  std::vector<std::vector<Eigen::Vector2d>> pixels_;
  Tracks tracks_;
  std::vector<uint32_t> element_track_;
  std::vector<std::vector<uint32_t>> image_elements_;
  std::vector<Eigen::Vector2d> plane_points_;                     // [element]
  std::vector<std::optional<geometry::Rigid3>> camera_from_map_;  // [image]
  std::vector<std::optional<Eigen::Vector3d>> points_;            // [track]
  std::vector<uint8_t> observed_;                                 // [element]
};

}  // namespace lararium::train
