#include "shared/vision/tracker.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <vector>

#include "shared/core/random.h"
#include "shared/vision/follow_map.h"
#include "tests/vision/poster.h"

namespace lararium::vision {
namespace {

using geometry::CameraModel;
using geometry::Frame;
using geometry::Rigid3;
using test::CornerError;
using test::MakePoster;
using test::MapOfPoster;
using test::PhotographPoster;
using test::PosterPose;

const CameraModel& kTrackedCamera = test::kPosterCamera;

class Tracker : public testing::Test {
 protected:
  Tracker() : poster_(MakePoster()), map_(MapOfPoster(poster_)) {}

  std::unique_ptr<PoseSource> Create() {
    auto tracker = CreateTracker({map_}, kTrackedCamera, {});
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
       {PosterPose(0.0, 0.0, 1.5), PosterPose(0.4, 0.1, 1.4), PosterPose(-0.3, 0.2, 1.8)}) {
    const TrackedFrame tracked = tracker->Track(PhotographPoster(poster_, truth, index++));
    ASSERT_TRUE(tracked.camera_from_map.has_value());
    EXPECT_EQ(tracked.state, TrackState::kTracking);
    EXPECT_EQ(tracked.reason, TrackReason::kNone);
    EXPECT_LT(CornerError(*tracked.camera_from_map, truth), 0.25);
    EXPECT_GE(tracked.inliers, 50);
  }
}

TEST_F(Tracker, TellsWhichPointsAPoseStandsOnAndWhereTheyWereSeen) {
  const auto tracker = Create();
  std::vector<SeenPoint> seen = {{1, {0, 0}}};
  for (int64_t index = 0; index < 3; ++index) {  // First located, then tracked.
    const Rigid3 truth = PosterPose(0.01 * static_cast<double>(index), 0.0, 1.5);
    const TrackedFrame tracked = tracker->Track(PhotographPoster(poster_, truth, index));
    ASSERT_TRUE(tracked.camera_from_map.has_value());
    tracker->Seen(seen);
    EXPECT_GE(seen.size(), 50u);
    for (const SeenPoint& point : seen) {
      ASSERT_LT(point.point, map_->points.size());
      const auto pixel = kTrackedCamera.Project(truth * map_->points[point.point].cast<double>());
      ASSERT_TRUE(pixel);
      EXPECT_LT((*pixel - point.pixel.cast<double>()).norm(), 3.0);
    }
  }
  Frame covered;
  covered.index = 3;
  covered.grey = cv::Mat(kTrackedCamera.height, kTrackedCamera.width, CV_8UC1, cv::Scalar(120));
  cv::cvtColor(covered.grey, covered.bgr, cv::COLOR_GRAY2BGR);
  EXPECT_FALSE(tracker->Track(covered).camera_from_map.has_value());
  tracker->Seen(seen);
  EXPECT_TRUE(seen.empty());
}

TEST_F(Tracker, SearchesLosesAndRecoversInOneFrame) {
  const auto tracker = Create();
  const Rigid3 pose = PosterPose(0.1, 0.0, 1.5);
  Frame covered;
  covered.grey = cv::Mat(kTrackedCamera.height, kTrackedCamera.width, CV_8UC1, cv::Scalar(120));
  cv::cvtColor(covered.grey, covered.bgr, cv::COLOR_GRAY2BGR);
  TrackedFrame tracked = tracker->Track(covered);
  EXPECT_EQ(tracked.state, TrackState::kSearching);
  EXPECT_EQ(tracked.reason, TrackReason::kTooFewFeatures);
  EXPECT_FALSE(tracked.camera_from_map.has_value());

  EXPECT_EQ(tracker->Track(PhotographPoster(poster_, pose, 1)).state, TrackState::kTracking);
  tracked = tracker->Track(covered);
  EXPECT_EQ(tracked.state, TrackState::kLost);
  EXPECT_EQ(tracked.reason, TrackReason::kTooFewFeatures);
  EXPECT_EQ(tracked.confidence, 0.0f);
  EXPECT_EQ(tracker->Track(PhotographPoster(poster_, pose, 3)).state, TrackState::kTracking);
}

TEST_F(Tracker, SaysThatItIsTooDark) {
  const auto tracker = Create();
  Frame dark;
  dark.grey = cv::Mat(kTrackedCamera.height, kTrackedCamera.width, CV_8UC1, cv::Scalar(2));
  cv::cvtColor(dark.grey, dark.bgr, cv::COLOR_GRAY2BGR);
  EXPECT_EQ(tracker->Track(dark).reason, TrackReason::kTooDark);
}

TEST_F(Tracker, FindsNoPoseOfAnotherPlace) {
  const auto tracker = Create();
  Random random(9);
  Frame other;
  other.grey = cv::Mat(kTrackedCamera.height, kTrackedCamera.width, CV_8UC1);
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
  const Rigid3 truth = PosterPose(0.2, 0.1, 1.5);
  Frame frame = PhotographPoster(poster_, truth, 0);
  cv::resize(frame.grey, frame.grey, cv::Size(360, 270), 0.0, 0.0, cv::INTER_AREA);
  cv::cvtColor(frame.grey, frame.bgr, cv::COLOR_GRAY2BGR);
  const TrackedFrame tracked = tracker->Track(frame);
  ASSERT_TRUE(tracked.camera_from_map.has_value());
  EXPECT_EQ(tracked.camera.width, 360);
  EXPECT_LT(CornerError(*tracked.camera_from_map, truth), 0.35);
}

TEST_F(Tracker, FollowsAroundALoopWithoutDrift) {
  const auto tracker = Create();
  constexpr int kFrames = 36;
  double worst = 0.0;
  int followed = 0;
  for (int i = 0; i <= kFrames; ++i) {
    const double turn = 2.0 * M_PI * i / kFrames;
    const Rigid3 truth = PosterPose(0.2 * std::cos(turn), 0.15 * std::sin(turn), 1.5);
    const TrackedFrame tracked = tracker->Track(PhotographPoster(poster_, truth, i));
    ASSERT_TRUE(tracked.camera_from_map.has_value());
    followed += tracked.followed ? 1 : 0;
    worst = std::max(worst, CornerError(*tracked.camera_from_map, truth));
  }
  EXPECT_EQ(followed, kFrames);
  EXPECT_LT(worst, 0.06);
}

TEST_F(Tracker, FollowsBehindAnOccluderAndInOtherLight) {
  const auto tracker = Create();
  for (int i = 0; i < 12; ++i) {
    const Rigid3 truth = PosterPose(0.01 * i, 0.0, 1.5);
    Frame frame = PhotographPoster(poster_, truth, i);
    frame.grey.convertTo(frame.grey, CV_8U, 1.0 - 0.05 * i, 3.0 * i);
    if (i > 2) {
      frame.grey(cv::Rect(150, 0, 200, 360)) = cv::Scalar(70);
    }
    const TrackedFrame tracked = tracker->Track(frame);
    ASSERT_TRUE(tracked.camera_from_map.has_value()) << i;
    EXPECT_EQ(tracked.followed, i > 0);
    EXPECT_LT(CornerError(*tracked.camera_from_map, truth), 0.1) << i;
  }
}

TEST_F(Tracker, FollowsAShake) {
  const auto tracker = Create();
  for (int i = 0; i < 20; ++i) {
    // The camera turns to and fro, by up to 25 pixels per frame.
    const Eigen::Vector3d turn(0.03 * std::sin(1.1 * i), 0.05 * std::sin(1.3 * i), 0.0);
    const Rigid3 truth = Rigid3{geometry::RotationFromVector(turn), Eigen::Vector3d::Zero()} *
                         PosterPose(0.0, 0.0, 1.5);
    const TrackedFrame tracked = tracker->Track(PhotographPoster(poster_, truth, i));
    ASSERT_TRUE(tracked.camera_from_map.has_value()) << i;
    EXPECT_EQ(tracked.followed, i > 0) << i;
    EXPECT_LT(CornerError(*tracked.camera_from_map, truth), 0.3) << i;
  }
}

TEST_F(Tracker, StandsStillWhereTheCameraDoes) {
  const auto tracker = Create();
  const Rigid3 truth = PosterPose(0.1, 0.05, 1.5);
  const Frame still = PhotographPoster(poster_, truth, 0);
  cv::RNG noise(3);
  double squares = 0.0;
  constexpr int kFrames = 20;
  for (int i = 0; i < kFrames; ++i) {
    Frame frame = still;
    frame.index = i;
    cv::Mat added(still.grey.size(), CV_16S);
    noise.fill(added, cv::RNG::NORMAL, 0.0, 4.0);
    cv::add(still.grey, added, frame.grey, cv::noArray(), CV_8U);
    const TrackedFrame tracked = tracker->Track(frame);
    ASSERT_TRUE(tracked.camera_from_map.has_value());
    squares += std::pow(CornerError(*tracked.camera_from_map, truth), 2);
  }
  EXPECT_LT(std::sqrt(squares / kFrames), 0.1);
}

TEST_F(Tracker, GivesTheSamePosesAgain) {
  TrackerOptions parallel;
  TrackerOptions serial;
  serial.threads = 1;
  auto one = *CreateTracker({map_}, kTrackedCamera, parallel);
  auto other = *CreateTracker({std::make_shared<const TrackedMap>(map_)}, kTrackedCamera, serial);
  for (int i = 0; i < 10; ++i) {
    const Frame frame = PhotographPoster(poster_, PosterPose(0.02 * i, 0.0, 1.5), i);
    const TrackedFrame a = one->Track(frame);
    const TrackedFrame b = other->Track(frame);
    ASSERT_TRUE(a.camera_from_map && b.camera_from_map);
    EXPECT_EQ(a.camera_from_map->Matrix3x4(), b.camera_from_map->Matrix3x4());
    EXPECT_EQ(a.covariance, b.covariance);
  }
}

// A walk along a wall that repeats itself. At frame kLeap the camera jumps by one period, which
// frame-to-frame tracking cannot notice.
class TrackerAtAPeriodicWall : public testing::Test {
 protected:
  static constexpr int kLeap = 10;

  TrackerAtAPeriodicWall() : wall_(test::MakePeriodicWall()), map_(MapOfPoster(wall_)) {}

  static Rigid3 Pose(int frame) {
    const double way = 0.002 * std::min(frame, 80) + (frame >= kLeap ? test::kWallPeriod : 0.0);
    return PosterPose(0.0, 0.0, 1.1) * Rigid3{Eigen::Quaterniond::Identity(), {0.15 - way, 0, 0}};
  }
  Frame Photograph(int frame) const { return PhotographPoster(wall_, Pose(frame), frame); }
  std::unique_ptr<PoseSource> Create(BackgroundWork background) const {
    TrackerOptions options;
    options.background = background;
    return *CreateTracker({map_}, kTrackedCamera, options);
  }

  cv::Mat wall_;
  std::shared_ptr<const SceneDatabase> map_;
};

TEST_F(TrackerAtAPeriodicWall, IsPutRightByTheBackgroundAtAReproducibleFrame) {
  constexpr int kChecked = 60;
  constexpr int kJoined = kChecked + 6;
  const auto tracker = Create(BackgroundWork::kJoined);
  const Rigid3 period{Eigen::Quaterniond::Identity(), {test::kWallPeriod, 0.0, 0.0}};
  for (int i = 0; i < kJoined + 10; ++i) {
    const TrackedFrame tracked = tracker->Track(Photograph(i));
    ASSERT_TRUE(tracked.camera_from_map.has_value()) << i;
    EXPECT_EQ(tracked.followed, i != 0 && i != kJoined) << i;
    const bool astray = i >= kLeap && i < kJoined;  // The jump is not noticed yet.
    const Rigid3 expected = astray ? Pose(i) * period : Pose(i);
    EXPECT_LT(CornerError(*tracked.camera_from_map, expected), 0.2) << i;
  }
}

TEST_F(TrackerAtAPeriodicWall, IsPutRightWhenTheBackgroundIsDone) {
  const auto tracker = Create(BackgroundWork::kFree);
  bool right = false;
  for (int i = 0; i < 1000 && !right; ++i) {
    const TrackedFrame tracked = tracker->Track(Photograph(i));
    ASSERT_TRUE(tracked.camera_from_map.has_value()) << i;
    right = i > kLeap && CornerError(*tracked.camera_from_map, Pose(i)) < 0.1;
    EXPECT_EQ(tracked.followed, i > 0 && !right) << i;
    EXPECT_FALSE(right && i <= 60) << i;  // Not before the check.
  }
  EXPECT_TRUE(right);
}

TEST_F(TrackerAtAPeriodicWall, GoesOnWhereTheBackgroundAgrees) {
  const auto tracker = Create(BackgroundWork::kJoined);
  for (int i = kLeap; i < kLeap + 70; ++i) {
    const TrackedFrame tracked = tracker->Track(Photograph(i));
    ASSERT_TRUE(tracked.camera_from_map.has_value()) << i;
    EXPECT_EQ(tracked.followed, i != kLeap) << i;
    EXPECT_LT(CornerError(*tracked.camera_from_map, Pose(i)), 0.1) << i;
  }
}

std::shared_ptr<const SceneDatabase> InUnitsOf(double metres, const SceneDatabase& map) {
  SceneDatabase other = map;
  for (Eigen::Vector3f& point : other.points) {
    point /= static_cast<float>(metres);
  }
  for (Keyframe& keyframe : other.keyframes) {
    keyframe.camera_from_map.translation /= metres;
  }
  return std::make_shared<const SceneDatabase>(std::move(other));
}

// From frame kLeap on, the camera walks along another wall, which differs only in its marks.
TEST_F(TrackerAtAPeriodicWall, IsPutRightByAMapOfAnotherUnit) {
  constexpr double kUnit = 100.0;  // Unit of the other wall's map, metres.
  constexpr int kMost = 100;       // frames
  const cv::Mat other = test::MakePeriodicWall(1);
  TrackerOptions options;
  options.background = BackgroundWork::kJoined;
  const auto tracker =
      *CreateTracker({map_, InUnitsOf(kUnit, *MapOfPoster(other))}, kTrackedCamera, options);
  const auto pose = [](int frame) {
    return PosterPose(0.0, 0.0, 1.1) *
           Rigid3{Eigen::Quaterniond::Identity(), {0.15 - 0.002 * frame, 0.0, 0.0}};
  };
  std::optional<int> corrected;
  for (int i = 0; i < corrected.value_or(kMost) + 5; ++i) {
    const TrackedFrame tracked =
        tracker->Track(PhotographPoster(i < kLeap ? wall_ : other, pose(i), i));
    ASSERT_TRUE(tracked.camera_from_map.has_value()) << i;
    if (tracked.map == 1 && !corrected) {
      corrected = i;
    }
    EXPECT_EQ(tracked.map, corrected ? 1u : 0u) << i;
    EXPECT_EQ(tracked.followed, i != 0 && i != corrected) << i;
    Rigid3 found = *tracked.camera_from_map;
    found.translation *= corrected ? kUnit : 1.0;
    EXPECT_LT(CornerError(found, pose(i)), 0.3) << i;
  }
  ASSERT_TRUE(corrected.has_value());
  EXPECT_GT(*corrected, kLeap);
}

// The camera of a visitor, of which the tracker is told nothing.
class TrackerOfAnUnknownCamera : public Tracker {
 protected:
  static constexpr double kZoom = 1.5;

  TrackerOfAnUnknownCamera() {
    CameraModel other = kTrackedCamera;
    other.fx = other.fy = 600.0;
    tracker_ = *CreateTracker({map_}, other, {.known_camera = false});
  }

  // The poster is seen at a slant, because a frontal view does not tell the focal length.
  static Rigid3 Pose(int64_t index) {
    return PosterPose(1.0 + 0.01 * static_cast<double>(index % 40), 0.3, 1.2);
  }

  // Tracks an image of the middle of the view, as digital zoom shows it. Returns the largest error
  // of the drawn corners of the poster in pixels; none if there is no pose.
  std::optional<double> Track(int64_t index, double zoom) {
    Frame frame = PhotographPoster(poster_, Pose(index), index);
    CameraModel truth = kTrackedCamera;
    if (zoom > 1.0) {
      const int width = static_cast<int>(truth.width / zoom);
      const int height = static_cast<int>(truth.height / zoom);
      const cv::Rect middle((truth.width - width) / 2, (truth.height - height) / 2, width, height);
      const cv::Size size(truth.width, truth.height);
      cv::resize(frame.grey(middle).clone(), frame.grey, size, 0, 0, cv::INTER_CUBIC);
      cv::cvtColor(frame.grey, frame.bgr, cv::COLOR_GRAY2BGR);
      truth.fx = truth.fy = zoom * truth.fx;
    }
    last_ = tracker_->Track(frame);
    if (!last_.camera_from_map) {
      return std::nullopt;
    }
    double worst = 0.0;
    for (const SeenPoint& seen : Seen()) {
      const Eigen::Vector3d point = map_->points[seen.point].cast<double>();
      const auto drawn = last_.camera.Project(*last_.camera_from_map * point);
      const auto real = truth.Project(Pose(index) * point);
      worst = std::max(worst, drawn && real ? (*drawn - *real).norm() : 1e9);
    }
    return worst;
  }

  double FocalError(double zoom) const {
    return std::abs(std::log(last_.camera.Focal() / (zoom * kTrackedCamera.Focal())));
  }

  std::unique_ptr<PoseSource> tracker_;
  TrackedFrame last_;

 private:
  std::vector<SeenPoint> Seen() const {
    std::vector<SeenPoint> seen;
    tracker_->Seen(seen);
    return seen;
  }
};

TEST_F(TrackerOfAnUnknownCamera, FindsItsFocalLengthFromTheFirstImageOn) {
  for (int64_t index = 0; index < 30; ++index) {
    const std::optional<double> error = Track(index, 1.0);
    ASSERT_TRUE(error.has_value()) << index;
    EXPECT_LT(*error, 1.5) << index;
    EXPECT_LT(FocalError(1.0), index == 0 ? 0.05 : 0.03) << index;
  }
}

TEST_F(TrackerOfAnUnknownCamera, ShowsNothingWrongWhenItSwitchesLenses) {
  int untracked = 0;
  for (int64_t index = 0; index < 60; ++index) {
    const double zoom = index / 20 == 1 ? kZoom : 1.0;
    const std::optional<double> error = Track(index, zoom);
    untracked = error ? 0 : untracked + 1;
    EXPECT_LT(untracked, 3) << index;
    if (error) {
      EXPECT_LT(*error, 2.0) << index;
    }
    if (index == 39 || index == 43) {
      EXPECT_LT(FocalError(zoom), 0.03) << index;
    }
  }
}

// A wall in front of the left half of the poster that extends far up and down.
class TrackerBehindAWall : public Tracker {
 protected:
  static constexpr double kWall = 0.3;  // Metres in front of the poster.

  // The wall from x = left to 0.
  static OccluderMesh Wall(float left) {
    const auto z = static_cast<float>(kWall);
    return {{{left, -5, z}, {0, -5, z}, {0, 5, z}, {left, 5, z}}, {0, 1, 2, 0, 2, 3}};
  }
  static Rigid3 Pose(int index) { return PosterPose(0.1 + 0.004 * (index % 50), 0.0, 1.5); }
  Frame Photograph(int index, bool walled) const {
    Frame frame = PhotographPoster(poster_, Pose(index), index);
    if (walled) {
      const double end =
          kTrackedCamera.Project(Pose(index) * Eigen::Vector3d(0.0, 0.0, kWall))->x();
      frame.grey(cv::Rect(0, 0, static_cast<int>(end), kTrackedCamera.height)) = cv::Scalar(70);
    }
    return frame;
  }
  // Tracks one frame and expects an error of a fraction of a pixel.
  static TrackedFrame Follow(PoseSource& tracker, const Frame& frame) {
    const TrackedFrame tracked = tracker.Track(frame);
    EXPECT_EQ(tracked.followed, frame.index > 0) << frame.index;
    EXPECT_TRUE(tracked.camera_from_map.has_value()) << frame.index;
    if (tracked.camera_from_map) {
      EXPECT_LT(CornerError(*tracked.camera_from_map, Pose(static_cast<int>(frame.index))), 0.1);
    }
    return tracked;
  }
};

TEST_F(TrackerBehindAWall, LooksForNothingBehindTheOccluder) {
  const auto knowing = Create();
  const auto ignorant = Create();
  knowing->SetOccluders(0, std::vector<OccluderMesh>{Wall(-5.0f)});
  for (int i = 0; i < 25; ++i) {
    const Frame frame = Photograph(i, true);
    const TrackedFrame with = Follow(*knowing, frame);
    const TrackedFrame without = Follow(*ignorant, frame);
    if (i >= 5) {
      EXPECT_LE(with.features - with.inliers, 12) << i;  // Four trials, and a few by chance.
      EXPECT_GE(without.features - without.inliers, 60) << i;
      EXPECT_GE(with.inliers, without.inliers) << i;
    }
  }
}

TEST_F(TrackerBehindAWall, LosesNothingToAnOccluderThatIsNotThere) {
  const auto misled = Create();
  const auto ignorant = Create();
  misled->SetOccluders(0, std::vector<OccluderMesh>{Wall(-5.0f)});
  for (int i = 0; i < 25; ++i) {
    const Frame frame = Photograph(i, false);
    const int inliers = Follow(*ignorant, frame).inliers;
    EXPECT_GE(Follow(*misled, frame).inliers, inliers * 9 / 10) << i;
  }
}

TEST_F(TrackerBehindAWall, FindsOutThatTheOccluderIsGone) {
  constexpr int kGone = 25;
  const auto tracker = Create();
  tracker->SetOccluders(0, std::vector<OccluderMesh>{Wall(-5.0f)});
  int behind = 0;
  for (int i = 0; i < kGone + 40; ++i) {
    const int inliers = Follow(*tracker, Photograph(i, i < kGone)).inliers;
    behind = i < kGone ? std::max(behind, inliers) : behind;
    if (i == kGone + 39) {
      EXPECT_GE(inliers, behind * 3 / 2);
    }
  }
}

TEST_F(TrackerBehindAWall, FollowsWhereAnOccluderHidesAllThatIsLeft) {
  const auto tracker = Create();
  tracker->SetOccluders(0, std::vector<OccluderMesh>{Wall(-5.0f)});
  for (int i = 0; i < 10; ++i) {
    Follow(*tracker, Photograph(i, true));
  }
  // The camera does not move after the occluder is trusted; then the model covers everything.
  OccluderMesh everything = Wall(-5.0f);
  everything.positions[1].x() = everything.positions[2].x() = 5.0f;
  tracker->SetOccluders(0, std::vector<OccluderMesh>{everything});
  for (int i = 10; i < 40; ++i) {
    EXPECT_GE(Follow(*tracker, Photograph(i, i < 20)).inliers, 40) << i;
  }
}

// Except at the left, the keyframe's image shows another poster. Its patches therefore do not match
// in any image, but the detector recognises the points by their descriptors.
class TrackerInNewLight : public Tracker {
 protected:
  static constexpr int kLeft = 180;      // Width of the left part, out of 480 pixels.
  static constexpr int kUncovered = 10;  // Before this frame the camera sees the left part only.
  static constexpr int kChecked = 60;
  static constexpr int kMerged = kChecked + 6;

  TrackerInNewLight() {
    auto changed = std::make_shared<SceneDatabase>(*map_);
    cv::Mat& grey = changed->keyframes[0].grey;
    grey = grey.clone();
    cv::Mat right = grey.colRange(kLeft, grey.cols);
    cv::Mat flipped;
    cv::flip(right, flipped, -1);
    flipped.copyTo(right);
    map_ = changed;
  }
  static Rigid3 Pose(int index) { return PosterPose(0.02 * std::sin(0.1 * index), 0.0, 1.5); }
  Frame Photograph(int index) const {
    Frame frame = PhotographPoster(poster_, Pose(index), index);
    if (index < kUncovered) {
      frame.grey.colRange(kLeft - 30, kTrackedCamera.width) = cv::Scalar(70);
    }
    return frame;
  }
};

TEST_F(TrackerInNewLight, FollowsWhatTheDetectorFindsInTheBackground) {
  const auto tracker = Create();
  TrackerOptions options;
  options.threads = 1;
  const auto serial = *CreateTracker({map_}, kTrackedCamera, options);
  int before = 0;
  for (int i = 0; i < kMerged + 30; ++i) {
    const Frame frame = Photograph(i);
    const TrackedFrame tracked = tracker->Track(frame);
    ASSERT_TRUE(tracked.camera_from_map) << i;
    EXPECT_EQ(tracked.followed, i > 0) << i;
    EXPECT_LT(CornerError(*tracked.camera_from_map, Pose(i)), 0.1) << i;
    if (i < kMerged + 3) {
      const TrackedFrame again = serial->Track(frame);
      ASSERT_TRUE(again.camera_from_map) << i;
      EXPECT_EQ(tracked.camera_from_map->Matrix3x4(), again.camera_from_map->Matrix3x4()) << i;
    }
    before = i <= kMerged ? std::max(before, tracked.inliers) : before;
    if (i > kMerged + 2) {
      EXPECT_GE(tracked.inliers, before + 50) << i;
    }
  }
}

TEST_F(Tracker, FindsEveryFrameAnewWhereItIsToldTo) {
  TrackerOptions options;
  options.follow = false;
  auto tracker = *CreateTracker({map_}, kTrackedCamera, options);
  for (int i = 0; i < 3; ++i) {
    const TrackedFrame tracked =
        tracker->Track(PhotographPoster(poster_, PosterPose(0.02 * i, 0.0, 1.5), i));
    EXPECT_TRUE(tracked.camera_from_map.has_value());
    EXPECT_FALSE(tracked.followed);
  }
}

TEST_F(Tracker, FindsOneFrameAnewWhereItIsAsked) {
  const auto tracker = Create();
  for (int i = 0; i < 6; ++i) {
    if (i == 3) {
      tracker->Relocalize();
    }
    const TrackedFrame tracked =
        tracker->Track(PhotographPoster(poster_, PosterPose(0.01 * i, 0.0, 1.5), i));
    EXPECT_TRUE(tracked.camera_from_map.has_value());
    EXPECT_EQ(tracked.followed, i != 0 && i != 3) << i;
  }
}

TEST_F(Tracker, RefusesWhatItCannotUse) {
  EXPECT_FALSE(CreateTracker({map_}, CameraModel(), {}).ok());
  EXPECT_FALSE(CreateTracker({std::make_shared<SceneDatabase>()}, kTrackedCamera, {}).ok());
  TrackerOptions options;
  options.hypotheses = 0;
  EXPECT_FALSE(CreateTracker({map_}, kTrackedCamera, options).ok());
  options = {};
  options.ratio = 0.0f;
  EXPECT_FALSE(CreateTracker({map_}, kTrackedCamera, options).ok());
  options = {};
  options.min_inliers = 3;
  EXPECT_FALSE(CreateTracker({map_}, kTrackedCamera, options).ok());
}

}  // namespace
}  // namespace lararium::vision
