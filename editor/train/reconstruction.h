#pragma once

// The state of structure from motion: tracks, and what is known of their points
// and of the images' poses.

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "editor/train/tracks.h"
#include "shared/geometry/camera_model.h"
#include "shared/geometry/transform.h"

namespace lararium::train {

struct TriangulationOptions {
  double max_error_px = 4.0;
  double min_angle = 0.026;  // radians (1.5 degrees), the widest between two rays of a point
};

class Reconstruction {
 public:
  // pixels[image][feature]: raw. tracks must index them.
  Reconstruction(const geometry::CameraModel& camera,
                 std::vector<std::vector<Eigen::Vector2d>> pixels,
                 Tracks tracks);

  const geometry::CameraModel& camera() const { return camera_; }
  void SetCamera(const geometry::CameraModel& camera);

  size_t image_count() const { return pixels_.size(); }
  bool Located(uint32_t image) const { return camera_from_map_[image].has_value(); }
  const geometry::Rigid3& camera_from_map(uint32_t image) const { return *camera_from_map_[image]; }
  void Locate(uint32_t image, const geometry::Rigid3& camera_from_map) {
    camera_from_map_[image] = camera_from_map;
  }
  // Images with a pose, in order of index.
  std::vector<uint32_t> LocatedImages() const;

  // Track elements have ids, their positions in Tracks::elements.
  const Tracks& tracks() const { return tracks_; }
  std::span<const uint32_t> ElementsOf(uint32_t image) const { return image_elements_[image]; }
  uint32_t TrackOf(uint32_t element) const { return element_track_[element]; }
  uint32_t ImageOf(uint32_t element) const { return tracks_.elements[element].image; }
  const Eigen::Vector2d& Pixel(uint32_t element) const {
    return pixels_[tracks_.elements[element].image][tracks_.elements[element].feature];
  }
  // On the plane z = 1, undistorted.
  const Eigen::Vector2d& PlanePoint(uint32_t element) const { return plane_points_[element]; }

  bool HasPoint(uint32_t track) const { return points_[track].has_value(); }
  const Eigen::Vector3d& Point(uint32_t track) const { return *points_[track]; }
  void MovePoint(uint32_t track, const Eigen::Vector3d& point) { points_[track] = point; }
  // Whether the element is a sight of its track's point, not an outlier.
  bool Observed(uint32_t element) const { return observed_[element] != 0; }
  std::vector<uint32_t> Observations(uint32_t track) const;
  size_t ObservationCount(uint32_t track) const;
  size_t PointCount() const;

  // Squared distance in raw pixels from the point's projection; infinite behind the camera.
  double SquaredErrorPx(uint32_t element, const Eigen::Vector3d& point) const;

  // Finds the point of a track that has none, by consensus of the located images.
  bool Triangulate(uint32_t track, const TriangulationOptions& options);
  // Moves the point to where the rays of its observations meet, or drops it.
  void Reintersect(uint32_t track);
  // Makes every element in a located image that fits the point an observation.
  void Complete(uint32_t track, double max_error_px);
  // Drops observations of larger error, then the point if fewer than two are
  // left or their rays are too parallel. Returns how many were dropped.
  size_t Filter(uint32_t track, const TriangulationOptions& options);

  // Drops the point of a track most of whose sights do not fit it: what some of
  // them agree on is chance, the thing moved against the scene.
  void DropIfMoving(uint32_t track);

  // Forgets an image's pose and its observations.
  void Unlocate(uint32_t image);
  // The map in other axes and another unit.
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

  geometry::CameraModel camera_;
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
