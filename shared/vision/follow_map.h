#pragma once

// A scene database prepared for frame-to-frame tracking: image pyramids of the keyframes, the
// keyframes that observe each point, and the tangent plane of the surface at a point.

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "shared/vision/image_pyramid.h"
#include "shared/vision/scene_database.h"

namespace lararium::vision {

// Immutable; trackers of several cameras may share it.
class TrackedMap {
 public:
  explicit TrackedMap(std::shared_ptr<const SceneDatabase> database);

  const SceneDatabase& database() const { return *database_; }
  const std::shared_ptr<const SceneDatabase>& shared_database() const { return database_; }

  // Has no levels if the keyframe has no image.
  const ImagePyramid& pyramid(uint32_t keyframe) const { return pyramids_[keyframe]; }
  // Keyframes that have an image and observe the point, in ascending order.
  std::span<const uint32_t> KeyframesOf(uint32_t point) const;
  std::span<const Observation> ObservationsIn(uint32_t keyframe) const;
  // Median depth of the keyframe's points along its optical axis, in map units; 0 if it observes
  // no point.
  double median_depth(uint32_t keyframe) const { return median_depths_[keyframe]; }

  // The tangent plane at a point that the keyframe observes, as the vector n with n . p = 1 for all
  // points p of the plane in the keyframe's camera frame. It is fitted to the depths of the
  // neighbouring points in the keyframe; without usable neighbours the plane faces the camera.
  Eigen::Vector3d PlaneAt(uint32_t keyframe, uint32_t point) const;

 private:
  // Grid of image cells by which the observations of a keyframe are grouped.
  static constexpr int kColumns = 32;
  static constexpr int kRows = 24;
  static constexpr int kCells = kColumns * kRows;

  int CellOf(double x, double y) const;
  void FillGrid(uint32_t keyframe);

  std::shared_ptr<const SceneDatabase> database_;
  std::vector<ImagePyramid> pyramids_;
  std::vector<uint32_t> point_begin_;  // [points + 1]: Ranges of point_keyframes_.
  std::vector<uint32_t> point_keyframes_;
  std::vector<uint32_t> keyframe_begin_;  // [keyframes + 1]: Ranges of SceneDatabase::observations.
  std::vector<double> median_depths_;
  std::vector<uint32_t> cell_begin_;  // [keyframes][kCells + 1]: Ranges of by_cell_.
  std::vector<uint32_t> by_cell_;     // [observations]: Indices of observations, ordered by cell.
  std::vector<float> depths_;         // [observations]: Depth in the keyframe, map units.
};

// The pyramid level at which an image of this width is about 80 pixels wide.
int CoarsestLevel(int width);

}  // namespace lararium::vision
