#pragma once

// Finds what stands before the surfaces of the map, such as other visitors or a hand, so that it
// can hide people who are drawn. The image is compared with the nearest keyframes, warped to it by
// the depths of the map's points; the difference is normalised by the gain. Pixels are then
// labelled by that difference and by colour, and the labels follow the edges of the image.

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <span>
#include <vector>

#include "shared/geometry/camera_model.h"
#include "shared/geometry/frame_pool.h"
#include "shared/geometry/transform.h"
#include "shared/vision/foreground/foreground_labels.h"
#include "shared/vision/foreground/small_filters.h"
#include "shared/vision/scene_database.h"
#include "shared/vision/tracked_frame.h"

namespace lararium::vision {

// The foreground in images of one place.
class ForegroundMask {
 public:
  explicit ForegroundMask(std::shared_ptr<const SceneDatabase> map);

  // Returns the value of TrackedFrame::foreground for a frame with a pose. seen: the points that
  // support the pose. The result is empty if it cannot be trusted: few points were seen, the
  // keyframes explain them badly, or show too little of the image.
  cv::Mat Estimate(const TrackedFrame& tracked, std::span<const SeenPoint> seen);

 private:
  static constexpr size_t kViews = 5;  // Number of keyframes that an image is compared with.
  static constexpr size_t kDepths = 3;

  // A keyframe as a small pinhole image.
  struct View {
    geometry::Rigid3 camera_from_map;
    Eigen::Vector3d centre;  // Map units.
    double depth = 0.0;      // Median depth of its points, map units.
    cv::Mat image;           // CV_32FC2: grey value and length of its gradient per pixel.
    std::span<const Observation> observations;
  };

  void AddView(const Keyframe& keyframe, std::span<const Observation> observations);
  void ChooseViews(const geometry::Rigid3& camera_from_map);
  void SetCamera(const geometry::CameraModel& camera);
  // Estimates the inverse depth of each small pixel, as hypotheses: interpolated between the
  // nearest points, and at the farthest and the nearest of them.
  void EstimateDepths(const TrackedFrame& tracked);
  void PlaceSurfaces(const TrackedFrame& tracked);
  // Compares the image with one view under each hypothesis. The nearest view says what the image
  // would show without a foreground.
  void Compare(const View& view, bool nearest);
  // Factor by which the image is brighter than a warped view, where points were seen.
  float Gain(const cv::Mat& warped);
  // Turns differences into log odds of foreground. Returns false if they cannot be trusted.
  bool Judge();

  std::shared_ptr<const SceneDatabase> map_;
  geometry::CameraModel view_camera_;  // The pinhole camera of the views' small images.
  std::vector<View> views_;
  std::vector<std::pair<double, uint32_t>> ranking_;
  ForegroundLabels labels_;
  geometry::FramePool results_;

  // These members belong to the present image.
  geometry::CameraModel camera_;
  std::vector<Eigen::Vector2f> rays_;  // [small pixel]: Point on the plane z = 1.
  cv::Mat bgr_, grey_, mean_grey_;     // The small image: CV_8UC3, CV_32FC1, and 3 x 3 means of it.
  cv::Mat bytes_;                      // CV_8UC1 of the small image's size, for any use.
  std::vector<int> seen_;              // Small pixels that show seen points.
  cv::Mat is_point_, cells_of_, distance_;
  cv::Mat filtered_;  // CV_32FC1 of the cells' size, for any use.
  WindowMean mean_;
  std::array<cv::Mat, kDepths> cell_depths_;  // Inverse, in cells of 2 x 2 small pixels.
  std::array<cv::Mat, kDepths> depths_;       // Inverse, [small pixel].
  std::array<std::array<cv::Mat, 3>, kDepths> surfaces_;  // Point in the map: x, y, z.
  cv::Mat column_, row_, warped_;
  cv::Mat expected_;    // Grey values; negative where the nearest view shows nothing.
  cv::Mat difference_;  // Least difference of all views and hypotheses, standard deviations.
  std::vector<float> sample_;
  cv::Mat log_odds_;
};

// The opacity of a frame's foreground at the full size of its image, 0 to 255: CV_8UC1, empty if
// the frame has none. Drawing evaluates the guide on the GPU instead.
cv::Mat ForegroundOpacity(const TrackedFrame& tracked);

// Wraps a source of poses, so that its frames get their foreground. maps are the maps of the
// source.
std::unique_ptr<PoseSource> WithForeground(
    std::unique_ptr<PoseSource> poses, std::span<const std::shared_ptr<const SceneDatabase>> maps);

}  // namespace lararium::vision
