#include "editor/train/corner_tracker.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>

namespace lararium::train {

namespace {

constexpr double kTrackedWidth = 320.0;  // Width of the tracked images, pixels.
constexpr int kMostCorners = 220;
constexpr double kApart = 9.0;  // Minimum distance between corners, pixels of these images.
constexpr int kWhite = 250;
constexpr int kBlack = 5;

// Share of the pixels that are white or black.
double ShareClipped(const cv::Mat& grey) {
  const int white = cv::countNonZero(grey >= kWhite);
  const int black = cv::countNonZero(grey <= kBlack);
  return static_cast<double>(white + black) / static_cast<double>(grey.total());
}

}  // namespace

CoverageFrame CornerTracker::Measure(const cv::Mat& grey, double time) {
  cv::Mat small = grey;
  const double factor = std::min(kTrackedWidth / grey.cols, 1.0);
  if (factor < 1.0) {
    cv::resize(grey, small, cv::Size(), factor, factor, cv::INTER_AREA);
  } else {
    small = grey.clone();  // The caller's pixels may change.
  }
  const FrameMotion motion = meter_.Measure(small);
  CoverageFrame frame;
  frame.time = time;
  frame.shift = motion.shift;
  frame.sharpness = motion.sharpness;
  frame.brightness = cv::mean(small)[0] / 255.0;
  frame.clipped = ShareClipped(small);
  Follow(small);
  FindMore(small);
  for (size_t i = 0; i < corners_.size(); ++i) {
    frame.tracks.push_back({ids_[i], OnPlane(corners_[i].x, corners_[i].y, factor)});
  }
  frame.describe = [this, small, factor] { return Describe(small, factor); };
  previous_ = small;
  return frame;
}

// Converts a pixel of the small image to the plane z = 1.
Eigen::Vector2d CornerTracker::OnPlane(double x, double y, double factor) const {
  // c' = s (c + 0.5) - 0.5
  return camera_.PlaneFromPixel({(x + 0.5) / factor - 0.5, (y + 0.5) / factor - 0.5});
}

CoverageFeatures CornerTracker::Describe(const cv::Mat& small, double factor) {
  constexpr int kMostFeatures = 300;
  const vision::FeatureOptions options{.first_octave = 0, .max_features = kMostFeatures};
  CoverageFeatures described;
  if (!extractor_.Extract(small, options, features_).ok()) {
    return described;  // Empty features are never recognised.
  }
  for (const vision::Keypoint& keypoint : features_.keypoints) {
    described.on_plane.push_back(OnPlane(keypoint.x, keypoint.y, factor));
  }
  described.descriptors = features_.descriptors;
  return described;
}

void CornerTracker::Follow(const cv::Mat& small) {
  constexpr float kSame = 0.7f;  // Largest error after tracking forwards and backwards, pixels.
  if (corners_.empty() || previous_.size() != small.size()) {
    corners_.clear();
    ids_.clear();
    return;
  }
  std::vector<cv::Point2f> now;
  std::vector<cv::Point2f> back;
  std::vector<uint8_t> there;
  std::vector<uint8_t> and_back;
  const cv::Size window(15, 15);
  constexpr int kLevels = 4;
  cv::calcOpticalFlowPyrLK(previous_, small, corners_, now, there, cv::noArray(), window, kLevels);
  cv::calcOpticalFlowPyrLK(small, previous_, now, back, and_back, cv::noArray(), window, kLevels);
  const cv::Rect2f inside(0.0f, 0.0f, static_cast<float>(small.cols),
                          static_cast<float>(small.rows));
  size_t kept = 0;
  for (size_t i = 0; i < now.size(); ++i) {
    if (there[i] != 0 && and_back[i] != 0 && inside.contains(now[i]) &&
        cv::norm(back[i] - corners_[i]) < kSame) {
      corners_[kept] = now[i];
      ids_[kept] = ids_[i];
      ++kept;
    }
  }
  corners_.resize(kept);
  ids_.resize(kept);
}

void CornerTracker::FindMore(const cv::Mat& small) {
  const int wanted = kMostCorners - static_cast<int>(corners_.size());
  if (wanted <= 0) {
    return;
  }
  cv::Mat free(small.size(), CV_8UC1, cv::Scalar::all(255));
  for (const cv::Point2f& corner : corners_) {
    cv::circle(free, corner, static_cast<int>(kApart), cv::Scalar::all(0), cv::FILLED);
  }
  std::vector<cv::Point2f> found;
  cv::goodFeaturesToTrack(small, found, wanted, 0.01, kApart, free);
  for (const cv::Point2f& corner : found) {
    corners_.push_back(corner);
    ids_.push_back(next_id_++);
  }
}

geometry::CameraModel TypicalCamera(int width, int height) {
  geometry::CameraModel camera;
  camera.width = width;
  camera.height = height;
  camera.fx = camera.fy = 0.9 * std::max(width, height);  // About 58 degrees wide.
  camera.cx = 0.5 * (width - 1);
  camera.cy = 0.5 * (height - 1);
  return camera;
}

Eigen::Vector2d HalfView(const geometry::CameraModel& camera) {
  return {0.5 * camera.width / camera.fx, 0.5 * camera.height / camera.fy};
}

}  // namespace lararium::train
