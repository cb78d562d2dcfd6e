#include "tests/vision/poster.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "shared/core/random.h"
#include "shared/vision/features.h"
#include "tests/support/synthetic_world.h"

namespace lararium::test {
namespace {

constexpr double kMetresPerPixel = 0.002;  // Size of a poster pixel.
constexpr int kPosterWidth = 1000;
constexpr int kPosterHeight = 800;

// Converts poster pixels to metres: the middle is at the origin, y points up, and the poster is
// seen from +z.
Eigen::Matrix3d MapFromPoster() {
  Eigen::Matrix3d m;
  m << kMetresPerPixel, 0.0, -0.5 * (kPosterWidth - 1) * kMetresPerPixel,  //
      0.0, -kMetresPerPixel, 0.5 * (kPosterHeight - 1) * kMetresPerPixel,  //
      0.0, 0.0, 1.0;
  return m;
}

// Draws an ellipse at a random position. It is repeated `repeats` times in the horizontal direction
// and wraps around at the end.
void DrawBlob(Random& random, cv::Mat& image, int repeats) {
  const int period = image.cols / repeats;
  // One number is drawn in a statement, because compilers order the arguments of a call
  // differently.
  const int y = static_cast<int>(random.Below(image.rows));
  const int x = static_cast<int>(random.Below(period));
  const cv::Point centre(x, y);
  const int half_height = 2 + static_cast<int>(random.Below(16));
  const int half_width = 2 + static_cast<int>(random.Below(16));
  const cv::Size axes(half_width, half_height);
  const double angle = random.Uniform(0.0, 180.0);
  const cv::Scalar grey(random.Uniform(20.0, 235.0));
  for (int i = 0; i < repeats; ++i) {
    cv::ellipse(image, centre + cv::Point(i * period, 0), axes, angle, 0.0, 360.0, grey,
                cv::FILLED);
  }
}

}  // namespace

using geometry::CameraModel;
using geometry::Frame;
using geometry::Rigid3;
using vision::Features;
using vision::Keyframe;
using vision::Keypoint;
using vision::SceneDatabase;

cv::Mat MakePoster() {
  Random random(5);
  cv::Mat poster(kPosterHeight, kPosterWidth, CV_8UC1, cv::Scalar(128));
  for (int i = 0; i < 3000; ++i) {
    DrawBlob(random, poster, 1);
  }
  cv::GaussianBlur(poster, poster, cv::Size(), 1.0);
  return poster;
}

cv::Mat MakePeriodicWall(int marks) {
  Random random(6);
  const auto period = static_cast<int>(std::lround(kWallPeriod / kMetresPerPixel));
  cv::Mat wall(kPosterHeight, kPosterWidth + 2 * period, CV_8UC1, cv::Scalar(128));
  for (int i = 0; i < 600; ++i) {
    DrawBlob(random, wall, wall.cols / period);
  }
  wall = wall.colRange(period, period + kPosterWidth).clone();
  if (marks > 0) {
    random = Random(static_cast<uint64_t>(100 + marks));
  }
  constexpr int kMark = 80;
  for (int y = 40; y + kMark <= wall.rows; y += 160) {
    for (int x = 30; x + kMark <= wall.cols; x += 240) {
      cv::Mat mark = wall(cv::Rect(x, y, kMark, kMark));
      for (int i = 0; i < 60; ++i) {
        DrawBlob(random, mark, 1);
      }
    }
  }
  cv::GaussianBlur(wall, wall, cv::Size(), 1.0);
  return wall;
}

Frame PhotographPoster(const cv::Mat& poster, const Rigid3& camera_from_map, int64_t index) {
  constexpr int kOversampling = 2;
  const CameraModel fine = kPosterCamera.Resized(kOversampling * kPosterCamera.width,
                                                 kOversampling * kPosterCamera.height);
  Eigen::Matrix3d intrinsics;
  intrinsics << fine.fx, 0.0, fine.cx, 0.0, fine.fy, fine.cy, 0.0, 0.0, 1.0;
  Eigen::Matrix3d plane;
  const Eigen::Matrix3d rotation = camera_from_map.rotation.toRotationMatrix();
  plane << rotation.col(0), rotation.col(1), camera_from_map.translation;
  const Eigen::Matrix3d pixel_from_poster = intrinsics * plane * MapFromPoster();
  cv::Mat homography(3, 3, CV_64F);
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      homography.at<double>(row, column) = pixel_from_poster(row, column);
    }
  }
  cv::Mat large;
  cv::warpPerspective(poster, large, homography, cv::Size(fine.width, fine.height),
                      cv::INTER_LINEAR, cv::BORDER_CONSTANT, cv::Scalar(90));
  Frame frame;
  frame.index = index;
  cv::resize(large, frame.grey, cv::Size(kPosterCamera.width, kPosterCamera.height), 0.0, 0.0,
             cv::INTER_AREA);
  cv::cvtColor(frame.grey, frame.bgr, cv::COLOR_GRAY2BGR);
  return frame;
}

Rigid3 PosterPose(double x, double y, double z) { return LookAt({x, y, z}, {0.05, -0.02, 0.0}); }

std::shared_ptr<const SceneDatabase> MapOfPoster(const cv::Mat& poster) {
  SceneDatabase db;
  db.camera = kPosterCamera;
  Keyframe keyframe;
  keyframe.camera_from_map = PosterPose(0.05, -0.02, 1.6);
  const Frame frame = PhotographPoster(poster, keyframe.camera_from_map, 0);
  keyframe.grey = frame.grey;
  db.keyframes.push_back(keyframe);
  const Features features = *vision::ExtractFeatures(frame.grey, {});
  const Rigid3 map_from_camera = keyframe.camera_from_map.Inverse();
  const Eigen::Vector3d centre = keyframe.camera_from_map.Center();
  db.descriptor_begin.push_back(0);
  for (size_t f = 0; f < features.size(); ++f) {
    const Keypoint& k = features.keypoints[f];
    const Eigen::Vector3d ray =
        map_from_camera.rotation * kPosterCamera.PlaneFromPixel({k.x, k.y}).homogeneous();
    const auto point = static_cast<uint32_t>(db.points.size());
    db.points.push_back((centre - ray * (centre.z() / ray.z())).cast<float>());
    db.normals.push_back(Eigen::Vector3f::UnitZ());
    db.observation_counts.push_back(1);
    db.session_masks.push_back(1);
    db.descriptors.push_back(features.descriptors[f]);
    db.descriptor_point.push_back(point);
    db.descriptor_begin.push_back(point + 1);
    db.observations.push_back({point, 0, k.x, k.y, k.scale});
  }
  db.forest = vision::BuildForest(db.descriptors, {});
  EXPECT_TRUE(db.Validate().ok());
  return std::make_shared<const SceneDatabase>(std::move(db));
}

double CornerError(const Rigid3& estimate, const Rigid3& truth) {
  double largest = 0.0;
  for (const double x : {-0.4, 0.4}) {
    for (const double y : {-0.3, 0.3}) {
      const auto a = kPosterCamera.Project(estimate * Eigen::Vector3d(x, y, 0.0));
      const auto b = kPosterCamera.Project(truth * Eigen::Vector3d(x, y, 0.0));
      largest = std::max(largest, (a.value() - b.value()).norm());
    }
  }
  return largest;
}

}  // namespace lararium::test
