#include "editor/train/camera_transfer.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "shared/geometry/resampling.h"

namespace lararium::train {

using geometry::CameraModel;
using vision::Features;
using vision::Observation;

namespace {

Eigen::Vector2d PixelIn(const CameraModel& to, const CameraModel& from, float x, float y) {
  return to.PixelFromPlane(from.PlaneFromPixel({x, y}));
}

}  // namespace

void Resample(CameraModel from, const CameraModel& to, std::span<cv::Mat* const> images) {
  if (from == to || std::ranges::all_of(images, [](const cv::Mat* i) { return i->empty(); })) {
    return;
  }
  // Images that become much smaller are averaged, against aliasing.
  const bool average_first = from.Focal() > 1.5 * to.Focal();
  if (average_first) {
    from = from.Resized(
        std::max(1, static_cast<int>(std::lround(from.width * to.Focal() / from.Focal()))),
        std::max(1, static_cast<int>(std::lround(from.height * to.Focal() / from.Focal()))));
  }
  const cv::Mat pixels = geometry::PixelsSeenBy(from, to);
  for (cv::Mat* image : images) {
    if (image->empty()) {
      continue;
    }
    cv::Mat resampled;
    if (average_first) {
      cv::resize(*image, resampled, cv::Size(from.width, from.height), 0.0, 0.0, cv::INTER_AREA);
      *image = std::exchange(resampled, cv::Mat());
    }
    cv::remap(*image, resampled, pixels, cv::noArray(), cv::INTER_LINEAR, cv::BORDER_REPLICATE);
    *image = resampled;
  }
}

Features FeaturesIn(const CameraModel& to, const CameraModel& from, const Features& features) {
  if (from == to) {
    return features;
  }
  Features moved;
  for (size_t f = 0; f < features.size(); ++f) {
    vision::Keypoint keypoint = features.keypoints[f];
    const Eigen::Vector2d pixel = PixelIn(to, from, keypoint.x, keypoint.y);
    if (to.Contains(pixel)) {
      keypoint.x = static_cast<float>(pixel.x());
      keypoint.y = static_cast<float>(pixel.y());
      keypoint.scale *= static_cast<float>(to.Focal() / from.Focal());
      moved.keypoints.push_back(keypoint);
      moved.descriptors.push_back(features.descriptors[f]);
    }
  }
  return moved;
}

std::vector<Observation> ObservationsIn(const CameraModel& to,
                                        const CameraModel& from,
                                        std::vector<Observation> observations) {
  if (from == to) {
    return observations;
  }
  for (Observation& o : observations) {
    const Eigen::Vector2d pixel = PixelIn(to, from, o.x, o.y);
    o.x = static_cast<float>(pixel.x());
    o.y = static_cast<float>(pixel.y());
    o.scale *= static_cast<float>(to.Focal() / from.Focal());
  }
  std::erase_if(observations, [&](const Observation& o) { return !to.Contains({o.x, o.y}); });
  return observations;
}

}  // namespace lararium::train
