#include "shared/vision/tracker.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "shared/core/random.h"
#include "tests/support/synthetic_world.h"

namespace lararium::vision {
namespace {

using geometry::CameraModel;
using geometry::Frame;
using geometry::Rigid3;

constexpr double kMetresPerPixel = 0.002;  // of the poster, which lies in the plane z = 0
constexpr int kPosterWidth = 1000;
constexpr int kPosterHeight = 800;

const CameraModel kCamera = {
    .width = 480, .height = 360, .fx = 420.0, .fy = 420.0, .cx = 239.5, .cy = 179.5};

cv::Mat Poster() {
  Random random(5);
  cv::Mat poster(kPosterHeight, kPosterWidth, CV_8UC1, cv::Scalar(128));
  for (int i = 0; i < 3000; ++i) {
    const cv::Point centre(static_cast<int>(random.Below(kPosterWidth)),
                           static_cast<int>(random.Below(kPosterHeight)));
    const cv::Size axes(2 + static_cast<int>(random.Below(16)),
                        2 + static_cast<int>(random.Below(16)));
    cv::ellipse(poster, centre, axes, random.Uniform(0.0, 180.0), 0.0, 360.0,
                cv::Scalar(random.Uniform(20.0, 235.0)), cv::FILLED);
  }
  cv::GaussianBlur(poster, poster, cv::Size(), 1.0);
  return poster;
}

// Poster pixel to metres: the middle at the origin, y up, seen from +z.
Eigen::Matrix3d MapFromPoster() {
  Eigen::Matrix3d m;
  m << kMetresPerPixel, 0.0, -0.5 * (kPosterWidth - 1) * kMetresPerPixel,  //
      0.0, -kMetresPerPixel, 0.5 * (kPosterHeight - 1) * kMetresPerPixel,  //
      0.0, 0.0, 1.0;
  return m;
}

// The poster as a camera sees it, four rays for each pixel.
Frame Photograph(const cv::Mat& poster, const Rigid3& camera_from_map, int64_t index) {
  constexpr int kOversampling = 2;
  const CameraModel fine =
      kCamera.Resized(kOversampling * kCamera.width, kOversampling * kCamera.height);
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
  cv::resize(large, frame.grey, cv::Size(kCamera.width, kCamera.height), 0.0, 0.0, cv::INTER_AREA);
  cv::cvtColor(frame.grey, frame.bgr, cv::COLOR_GRAY2BGR);
  return frame;
}

Rigid3 PoseAt(double x, double y, double z) { return test::LookAt({x, y, z}, {0.05, -0.02, 0.0}); }

// A map of the poster from one photograph with a known pose.
std::shared_ptr<const SceneDatabase> MapOfPoster(const cv::Mat& poster) {
  SceneDatabase db;
  db.camera = kCamera;
  Keyframe keyframe;
  keyframe.camera_from_map = PoseAt(0.05, -0.02, 1.6);
  const Frame frame = Photograph(poster, keyframe.camera_from_map, 0);
  keyframe.grey = frame.grey;
  db.keyframes.push_back(keyframe);
  const Features features = *ExtractFeatures(frame.grey, {});
  const Rigid3 map_from_camera = keyframe.camera_from_map.Inverse();
  const Eigen::Vector3d centre = keyframe.camera_from_map.Center();
  db.descriptor_begin.push_back(0);
  for (size_t f = 0; f < features.size(); ++f) {
    const Keypoint& k = features.keypoints[f];
    const Eigen::Vector3d ray =
        map_from_camera.rotation * kCamera.PlaneFromPixel({k.x, k.y}).homogeneous();
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
  db.forest = BuildForest(db.descriptors, {});
  EXPECT_TRUE(db.Validate().ok());
  return std::make_shared<const SceneDatabase>(std::move(db));
}

double CornerError(const Rigid3& estimate, const Rigid3& truth) {
  double largest = 0.0;
  for (const double x : {-0.4, 0.4}) {
    for (const double y : {-0.3, 0.3}) {
      const auto a = kCamera.Project(estimate * Eigen::Vector3d(x, y, 0.0));
      const auto b = kCamera.Project(truth * Eigen::Vector3d(x, y, 0.0));
      largest = std::max(largest, (a.value() - b.value()).norm());
    }
  }
  return largest;
}

class Tracker : public testing::Test {
 protected:
  Tracker() : poster_(Poster()), map_(MapOfPoster(poster_)) {}

  std::unique_ptr<PoseSource> Create() {
    auto tracker = CreateTracker({map_}, kCamera, {});
    EXPECT_TRUE(tracker.ok());
    return *std::move(tracker);
  }

  cv::Mat poster_;
  std::shared_ptr<const SceneDatabase> map_;
};

TEST_F(Tracker, RegistersAPosterToAFractionOfAPixel) {
  const auto tracker = Create();
  int64_t index = 0;
  for (const Rigid3& truth :
       {PoseAt(0.0, 0.0, 1.5), PoseAt(0.4, 0.1, 1.4), PoseAt(-0.3, 0.2, 1.8)}) {
    const TrackedFrame tracked = tracker->Track(Photograph(poster_, truth, index++));
    ASSERT_TRUE(tracked.camera_from_map.has_value());
    EXPECT_EQ(tracked.state, TrackState::kTracking);
    EXPECT_EQ(tracked.reason, TrackReason::kNone);
    EXPECT_LT(CornerError(*tracked.camera_from_map, truth), 0.25);
    EXPECT_GE(tracked.inliers, 50);
  }
}

TEST_F(Tracker, SearchesLosesAndRecoversInOneFrame) {
  const auto tracker = Create();
  const Rigid3 pose = PoseAt(0.1, 0.0, 1.5);
  Frame covered;
  covered.grey = cv::Mat(kCamera.height, kCamera.width, CV_8UC1, cv::Scalar(120));
  cv::cvtColor(covered.grey, covered.bgr, cv::COLOR_GRAY2BGR);
  TrackedFrame tracked = tracker->Track(covered);
  EXPECT_EQ(tracked.state, TrackState::kSearching);
  EXPECT_EQ(tracked.reason, TrackReason::kTooFewFeatures);
  EXPECT_FALSE(tracked.camera_from_map.has_value());

  EXPECT_EQ(tracker->Track(Photograph(poster_, pose, 1)).state, TrackState::kTracking);
  tracked = tracker->Track(covered);
  EXPECT_EQ(tracked.state, TrackState::kLost);
  EXPECT_EQ(tracked.reason, TrackReason::kTooFewFeatures);
  EXPECT_EQ(tracked.confidence, 0.0f);
  EXPECT_EQ(tracker->Track(Photograph(poster_, pose, 3)).state, TrackState::kTracking);
}

TEST_F(Tracker, SaysThatItIsTooDark) {
  const auto tracker = Create();
  Frame dark;
  dark.grey = cv::Mat(kCamera.height, kCamera.width, CV_8UC1, cv::Scalar(2));
  cv::cvtColor(dark.grey, dark.bgr, cv::COLOR_GRAY2BGR);
  EXPECT_EQ(tracker->Track(dark).reason, TrackReason::kTooDark);
}

TEST_F(Tracker, FindsNoPoseOfAnotherPlace) {
  const auto tracker = Create();
  Random random(9);
  Frame other;
  other.grey = cv::Mat(kCamera.height, kCamera.width, CV_8UC1);
  for (int row = 0; row < other.grey.rows; ++row) {
    for (int column = 0; column < other.grey.cols; ++column) {
      other.grey.at<uint8_t>(row, column) = static_cast<uint8_t>(random.Below(256));
    }
  }
  cv::GaussianBlur(other.grey, other.grey, cv::Size(), 2.5);
  cv::equalizeHist(other.grey, other.grey);
  cv::cvtColor(other.grey, other.bgr, cv::COLOR_GRAY2BGR);
  const TrackedFrame tracked = tracker->Track(other);
  EXPECT_FALSE(tracked.camera_from_map.has_value());
  EXPECT_TRUE(tracked.reason == TrackReason::kTooFewMatches ||
              tracked.reason == TrackReason::kNoConsistentPose);
}

TEST_F(Tracker, TakesImagesOfAnotherSize) {
  const auto tracker = Create();
  const Rigid3 truth = PoseAt(0.2, 0.1, 1.5);
  Frame frame = Photograph(poster_, truth, 0);
  cv::resize(frame.grey, frame.grey, cv::Size(360, 270), 0.0, 0.0, cv::INTER_AREA);
  cv::cvtColor(frame.grey, frame.bgr, cv::COLOR_GRAY2BGR);
  const TrackedFrame tracked = tracker->Track(frame);
  ASSERT_TRUE(tracked.camera_from_map.has_value());
  EXPECT_EQ(tracked.camera.width, 360);
  EXPECT_LT(CornerError(*tracked.camera_from_map, truth), 0.35);
}

TEST_F(Tracker, RefusesWhatItCannotUse) {
  EXPECT_FALSE(CreateTracker({map_}, CameraModel(), {}).ok());
  EXPECT_FALSE(CreateTracker({std::make_shared<SceneDatabase>()}, kCamera, {}).ok());
  TrackerOptions options;
  options.hypotheses = 0;
  EXPECT_FALSE(CreateTracker({map_}, kCamera, options).ok());
  options = {};
  options.ratio = 0.0f;
  EXPECT_FALSE(CreateTracker({map_}, kCamera, options).ok());
  options = {};
  options.min_inliers = 3;
  EXPECT_FALSE(CreateTracker({map_}, kCamera, options).ok());
}

}  // namespace
}  // namespace lararium::vision
