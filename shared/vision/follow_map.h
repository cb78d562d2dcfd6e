#pragma once

// What following needs of a scene database beyond the database: its keyframes as
// pyramids, who sees a point, and how the surface lies around it.

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "shared/vision/image_pyramid.h"
#include "shared/vision/scene_database.h"

namespace lararium::vision {

// Immutable; trackers of several cameras may share it.
class FollowMap {
 public:
  explicit FollowMap(std::shared_ptr<const SceneDatabase> database);

  const SceneDatabase& database() const { return *database_; }

  // No levels where the keyframe has no image.
  const ImagePyramid& pyramid(uint32_t keyframe) const { return pyramids_[keyframe]; }
  // Keyframes with an image that saw the point, ascending.
  std::span<const uint32_t> KeyframesOf(uint32_t point) const;
  std::span<const Observation> ObservationsIn(uint32_t keyframe) const;
  // Of its points, along the optical axis, map units; 0 where it sees none.
  double median_depth(uint32_t keyframe) const { return median_depths_[keyframe]; }

  // The tangent plane at a point that the keyframe sees: n with n . p = 1 for its
  // points p in the camera's frame. Fitted to the depths of the points that the
  // keyframe sees around it; where these say nothing it faces the camera.
  Eigen::Vector3d PlaneAt(uint32_t keyframe, uint32_t point) const;

 private:
  // Observations of a keyframe by cells of its image.
  static constexpr int kColumns = 32;
  static constexpr int kRows = 24;
  static constexpr int kCells = kColumns * kRows;

  int CellOf(double x, double y) const;
  void FillGrid(uint32_t keyframe);

  std::shared_ptr<const SceneDatabase> database_;
  std::vector<ImagePyramid> pyramids_;
  std::vector<uint32_t> point_begin_;  // [points + 1]: ranges in point_keyframes_
  std::vector<uint32_t> point_keyframes_;
  std::vector<uint32_t> keyframe_begin_;  // [keyframes + 1]: ranges in observations
  std::vector<double> median_depths_;
  std::vector<uint32_t> cell_begin_;  // [keyframes][kCells + 1]: ranges in by_cell_
  std::vector<uint32_t> by_cell_;     // [observations]: their indices
  std::vector<float> depths_;         // [observations]
};

// How many levels bring an image of this width to about 80 pixels.
int CoarsestLevel(int width);

}  // namespace lararium::vision
