#include "editor/train/trainer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <opencv2/imgproc.hpp>
#include <set>
#include <span>

#include "editor/train/session_merge.h"
#include "shared/core/parallel.h"
#include "shared/core/random.h"

namespace lararium::train {
namespace {

using geometry::Frame;
using ::testing::HasSubstr;

// A recording from frames in memory.
class ListSource : public capture::FrameSource {
 public:
  explicit ListSource(std::vector<cv::Mat> images) : images_(std::move(images)) {}

  Result<std::optional<Frame>> Next() override {
    if (next_ >= images_.size()) {
      return std::optional<Frame>();
    }
    Frame frame;
    frame.index = static_cast<int64_t>(next_);
    frame.grey = images_[next_++];
    cv::cvtColor(frame.grey, frame.bgr, cv::COLOR_GRAY2BGR);
    return std::optional<Frame>(frame);
  }
  Status Seek(int64_t index) override {
    next_ = static_cast<size_t>(index);
    return Status();
  }
  std::optional<int64_t> frame_count() const override {
    return static_cast<int64_t>(images_.size());
  }
  int width() const override { return 320; }
  int height() const override { return 240; }
  double frames_per_second() const override { return 25.0; }
  bool live() const override { return false; }
  std::string FrameName(int64_t index) const override {
    char name[32];
    std::snprintf(name, sizeof(name), "%06d.png", static_cast<int>(index));
    return name;
  }

 private:
  std::vector<cv::Mat> images_;
  size_t next_ = 0;
};

// Fails to read some images in some passes; the other images keep their indices.
class FlakySource : public ListSource {
 public:
  // fails[i]: the passes, counted from 1, in which image i cannot be read.
  FlakySource(std::vector<cv::Mat> images, std::map<int64_t, std::set<int>> fails)
      : ListSource(std::move(images)), fails_(std::move(fails)) {}

  Result<std::optional<Frame>> Next() override {
    Result<std::optional<Frame>> frame = ListSource::Next();
    if (frame->has_value() && fails_[(*frame)->index].contains(reading_)) {
      return Status::Error("flaky", "cannot be read");
    }
    return frame;
  }
  Status Seek(int64_t index) override {
    ++reading_;
    return ListSource::Seek(index);
  }

 private:
  std::map<int64_t, std::set<int>> fails_;
  int reading_ = 0;
};

geometry::CameraModel Camera() {
  geometry::CameraModel camera;
  camera.width = 320;
  camera.height = 240;
  camera.fx = camera.fy = 300.0;
  camera.cx = 159.5;
  camera.cy = 119.5;
  return camera;
}

// Blobs of many sizes.
cv::Mat Texture(uint64_t seed) {
  Random random(seed);
  cv::Mat image(480, 640, CV_8UC1, cv::Scalar(128));
  for (int i = 0; i < 1500; ++i) {
    const cv::Point center{static_cast<int>(random.Below(640)),
                           static_cast<int>(random.Below(480))};
    const int radius = 2 + static_cast<int>(random.Below(10));
    cv::circle(image, center, radius, cv::Scalar(random.Below(256)), cv::FILLED, cv::LINE_AA);
  }
  return image;
}

// A textured wall at depth 4 and a smaller one in front of it at depth 3, seen by a camera at
// x = position that is turned by angle about the vertical axis.
cv::Mat Render(double position, double angle) {
  static const cv::Mat kWall = Texture(1);
  static const cv::Mat kFront = Texture(2);
  const double f = Camera().fx;
  const cv::Matx33d k(f, 0, Camera().cx, 0, f, Camera().cy, 0, 0, 1);
  const cv::Matx33d turn(std::cos(angle), 0, -std::sin(angle), 0, 1, 0, std::sin(angle), 0,
                         std::cos(angle));
  const auto pixel_from_texture = [&](double depth, double width) {
    const double unit = width / 640.0;  // Metres per texel.
    const cv::Matx33d point(unit, 0, -320 * unit - position, 0, unit, -240 * unit, 0, 0, depth);
    return k * turn * point;
  };
  cv::Mat image;
  cv::warpPerspective(kWall, image, pixel_from_texture(4.0, 8.0), cv::Size(320, 240));
  cv::Mat front;
  cv::warpPerspective(kFront, front, pixel_from_texture(3.0, 1.6), cv::Size(320, 240));
  cv::Mat mask;
  cv::warpPerspective(cv::Mat(kFront.size(), CV_8UC1, cv::Scalar(255)), mask,
                      pixel_from_texture(3.0, 1.6), cv::Size(320, 240));
  front.copyTo(image, mask == 255);
  return image;
}

std::vector<cv::Mat> WalkPast(int count) {
  std::vector<cv::Mat> images;
  for (int i = 0; i < count; ++i) {
    const double t = static_cast<double>(i) / (count - 1) - 0.5;
    images.push_back(Render(1.2 * t, -0.25 * t));
  }
  return images;
}

TrainOptions KnownCamera() {
  TrainOptions options;
  options.intrinsics = Camera();
  options.max_features = 600;
  return options;
}

Result<TrainResult> TrainOn(std::vector<cv::Mat> images, const TrainOptions& options) {
  ListSource source(std::move(images));
  NoProgress progress;
  return Train(source, options, progress, *MakeSilentLog());
}

TEST(Trainer, BuildsAValidDatabaseOfAPlace) {
  const Result<TrainResult> result = TrainOn(WalkPast(8), KnownCamera());
  ASSERT_TRUE(result.ok()) << result.message();
  EXPECT_EQ(result->report.located.size(), 8u);
  EXPECT_TRUE(result->report.unlocated.empty());
  EXPECT_TRUE(result->database.Validate().ok());
  EXPECT_GT(result->database.points.size(), 100u);
  EXPECT_LT(result->report.mean_reprojection_error_px, 0.5);
  EXPECT_EQ(result->database.keyframes[3].name, "000003.png");
  // The camera moved along a line at constant speed.
  const auto center = [&](size_t i) { return result->report.located[i].camera_from_map.Center(); };
  const double length = (center(7) - center(0)).norm();
  for (size_t i = 0; i < 8; ++i) {
    const Eigen::Vector3d expected =
        center(0) + (center(7) - center(0)) * (static_cast<double>(i) / 7.0);
    EXPECT_LT((center(i) - expected).norm(), 0.01 * length) << i;
  }
}

TEST(Trainer, ReportsOnEveryFrame) {
  TrainOptions options = KnownCamera();
  options.max_keyframes = 5;
  const Result<TrainResult> result = TrainOn(WalkPast(8), options);
  ASSERT_TRUE(result.ok()) << result.message();
  ASSERT_EQ(result->report.frame_reports.size(), 8u);
  int keyframes = 0;
  for (size_t i = 0; i < 8; ++i) {
    const FrameReport& frame = result->report.frame_reports[i];
    EXPECT_EQ(frame.frame_index, static_cast<int64_t>(i));
    EXPECT_TRUE(frame.camera_from_map.has_value());
    EXPECT_GT(frame.features, 150);
    EXPECT_GT(frame.observations, 50);
    EXPECT_LT(frame.observations, frame.features);
    EXPECT_GT(frame.median_error_px, 0.0);
    EXPECT_LT(frame.median_error_px, 1.0);
    EXPECT_GT(frame.motion.sharpness, 0.0);
    EXPECT_EQ(frame.motion.shift > 0.0, i > 0);
    keyframes += frame.keyframe ? 1 : 0;
  }
  EXPECT_EQ(keyframes, result->report.keyframes);
}

TEST(Trainer, GivesTheSameBytesTwice) {
  const Result<TrainResult> first = TrainOn(WalkPast(6), KnownCamera());
  const Result<TrainResult> second = TrainOn(WalkPast(6), KnownCamera());
  ASSERT_TRUE(first.ok() && second.ok());
  EXPECT_EQ(vision::SerializeSceneDatabase(first->database),
            vision::SerializeSceneDatabase(second->database));
}

TEST(Trainer, GivesTheSameBytesWithAnyNumberOfThreads) {
  std::vector<std::vector<std::byte>> bytes;
  for (const int threads : {1, 2, 5}) {
    const ThreadLimit limit(threads);
    const Result<TrainResult> result = TrainOn(WalkPast(5), KnownCamera());
    ASSERT_TRUE(result.ok()) << result.message();
    bytes.push_back(vision::SerializeSceneDatabase(result->database));
  }
  EXPECT_EQ(bytes[0], bytes[1]);
  EXPECT_EQ(bytes[0], bytes[2]);
}

TEST(Trainer, RefusesAStandingCamera) {
  const Result<TrainResult> result =
      TrainOn(std::vector<cv::Mat>(6, Render(0.0, 0.0)), KnownCamera());
  ASSERT_FALSE(result.ok());
  EXPECT_THAT(result.message(), HasSubstr("too little parallax"));
}

TEST(Trainer, LocatesTheFramesBetweenKeyframes) {
  TrainOptions options = KnownCamera();
  options.max_keyframes = 6;
  const Result<TrainResult> result = TrainOn(WalkPast(14), options);
  ASSERT_TRUE(result.ok()) << result.message();
  EXPECT_LE(result->report.keyframes, 6);
  EXPECT_GE(result->report.located.size(), 13u);
  for (size_t i = 1; i < result->report.located.size(); ++i) {
    EXPECT_LT(result->report.located[i - 1].frame_index, result->report.located[i].frame_index);
  }
}

// Training reads a source three times: all frames, then the keyframes, then all frames again.
TEST(Trainer, TakesFramesThatReadOnlyOnce) {
  TrainOptions options = KnownCamera();
  options.max_keyframes = 6;
  const Result<TrainResult> whole = TrainOn(WalkPast(14), options);
  ASSERT_TRUE(whole.ok()) << whole.message();
  int64_t keyframe = 0;  // A keyframe from the middle.
  for (const FrameReport& frame : whole->report.frame_reports) {
    keyframe = frame.keyframe && frame.frame_index < 9 ? frame.frame_index : keyframe;
  }
  // The survey misses two frames, one of them the last one. A keyframe is missed later.
  const int64_t missed = keyframe == 5 ? 4 : 5;
  FlakySource source(WalkPast(14), {{missed, {1}}, {13, {1}}, {keyframe, {3}}});
  NoProgress progress;
  const Result<TrainResult> result = Train(source, options, progress, *MakeSilentLog());
  ASSERT_TRUE(result.ok()) << result.message();
  const std::vector<FrameReport>& reports = result->report.frame_reports;
  ASSERT_EQ(reports.size(), 12u);
  for (const FrameReport& frame : reports) {
    EXPECT_NE(frame.frame_index, missed);
    EXPECT_TRUE(frame.camera_from_map.has_value()) << frame.frame_index;
  }
}

// WalkPast while autofocus moves: the focal length of each image is ratios[i] times the camera's.
std::vector<cv::Mat> Breathing(std::span<const double> ratios) {
  std::vector<cv::Mat> images = WalkPast(static_cast<int>(ratios.size()));
  for (size_t i = 0; i < images.size(); ++i) {
    const double r = ratios[i];
    const cv::Matx23d zoom(r, 0, (1 - r) * Camera().cx, 0, r, (1 - r) * Camera().cy);
    cv::warpAffine(images[i], images[i], zoom, images[i].size(), cv::INTER_LINEAR,
                   cv::BORDER_REPLICATE);
  }
  return images;
}

TEST(Trainer, TellsTheFocalLengthOfEachFrameWhereAutofocusMoves) {
  std::vector<double> ratios;
  for (int i = 0; i < 16; ++i) {
    ratios.push_back(1.0 + 0.04 * std::sin(0.35 * i));
  }
  TrainOptions options = KnownCamera();
  options.intrinsics.reset();
  options.keep_features = true;
  const Result<TrainResult> result = TrainOn(Breathing(ratios), options);
  ASSERT_TRUE(result.ok()) << result.message();
  ASSERT_EQ(result->report.located.size(), ratios.size());
  // Walking past two walls does not tell the mean focal length well.
  double mean = 0.0;  // This is the mean of the focal lengths as shares of the true ones.
  for (size_t i = 0; i < ratios.size(); ++i) {
    const double share = result->report.located[i].camera.fx / (ratios[i] * Camera().fx);
    mean += share / static_cast<double>(ratios.size());
  }
  for (size_t i = 0; i < ratios.size(); ++i) {
    EXPECT_NEAR(result->report.located[i].camera.fx / (ratios[i] * Camera().fx), mean, 0.015) << i;
  }
  // The map is that of one camera, and so are the features.
  const vision::SceneDatabase& map = result->database;
  ASSERT_EQ(result->features.size(), map.keyframes.size());
  for (const vision::Observation& o : map.observations) {
    EXPECT_TRUE(std::ranges::any_of(result->features[o.keyframe].keypoints,
                                    [&](const auto& k) { return k.x == o.x && k.y == o.y; }));
  }
  // As another session it becomes a part of a map from a lens that stands still.
  const Result<TrainResult> still = TrainOn(WalkPast(12), KnownCamera());
  ASSERT_TRUE(still.ok()) << still.message();
  ListSource source(Breathing(ratios));
  NoProgress progress;
  const auto both = AddSession(still->database, source, options, progress, *MakeSilentLog());
  ASSERT_TRUE(both.ok()) << both.message();
  EXPECT_LT(both->database.mean_reprojection_error_px, 0.5);
}

TEST(Trainer, KeepsTheBudgetOfPoints) {
  TrainOptions options = KnownCamera();
  options.max_points = 100;
  const Result<TrainResult> result = TrainOn(WalkPast(6), options);
  ASSERT_TRUE(result.ok()) << result.message();
  EXPECT_EQ(result->database.points.size(), 100u);
  EXPECT_TRUE(result->database.Validate().ok());
}

TEST(Trainer, RefusesACameraThatOnlyTurnsAndSaysSo) {
  std::vector<cv::Mat> images;
  for (int i = 0; i < 6; ++i) {
    images.push_back(Render(0.0, 0.03 * i));
  }
  const Result<TrainResult> result = TrainOn(images, KnownCamera());
  ASSERT_FALSE(result.ok());
  EXPECT_THAT(result.message(), HasSubstr("too little parallax"));
  EXPECT_THAT(result.message(), HasSubstr("000000.png to 000005.png"));
  EXPECT_THAT(result.message(), HasSubstr("walking sideways"));
}

TEST(Trainer, RefusesBlankImagesAndSaysSo) {
  const std::vector<cv::Mat> images(4, cv::Mat(240, 320, CV_8UC1, cv::Scalar(90)));
  const Result<TrainResult> result = TrainOn(images, KnownCamera());
  ASSERT_FALSE(result.ok());
  EXPECT_THAT(result.message(), HasSubstr("too few features in 4 of 4 images"));
}

TEST(Trainer, RefusesImagesWithoutOverlapAndSaysSo) {
  std::vector<cv::Mat> images;
  for (uint64_t i = 0; i < 4; ++i) {
    images.push_back(Texture(10 + i)(cv::Rect(0, 0, 320, 240)).clone());
  }
  const Result<TrainResult> result = TrainOn(images, KnownCamera());
  ASSERT_FALSE(result.ok());
  EXPECT_THAT(result.message(), HasSubstr("no two images show the same objects"));
  EXPECT_THAT(result.message(), HasSubstr("more slowly"));
}

TEST(Trainer, RefusesMovingThingsBeforeAStandingCamera) {
  std::vector<cv::Mat> images;
  for (int i = 0; i < 6; ++i) {
    images.push_back(Render(0.0, 0.0));
    Texture(2)(cv::Rect(100, 100, 40, 40))
        .copyTo(images.back()(cv::Rect(20 + 15 * i, 100, 40, 40)));
  }
  EXPECT_FALSE(TrainOn(images, KnownCamera()).ok());
}

TEST(Trainer, RefusesASingleFrame) {
  EXPECT_THAT(TrainOn({Render(0, 0)}, KnownCamera()).message(), HasSubstr("fewer than two frames"));
}

TEST(Trainer, RefusesIntrinsicsOfAnotherSize) {
  TrainOptions options = KnownCamera();
  options.intrinsics = Camera().Resized(640, 480);
  EXPECT_THAT(TrainOn(WalkPast(2), options).message(), HasSubstr("another image size"));
}

TEST(Trainer, StopsWhenCancelled) {
  class CancelLater : public Progress {
   public:
    void Report(std::string_view step, double) override { cancelled_ |= step == "mapping"; }
    bool Cancelled() const override { return cancelled_; }

   private:
    bool cancelled_ = false;
  };
  ListSource source(WalkPast(5));
  CancelLater progress;
  const auto result = Train(source, KnownCamera(), progress, *MakeSilentLog());
  ASSERT_FALSE(result.ok());
  EXPECT_THAT(result.message(), HasSubstr("cancelled"));
}

TEST(TrainOptions, SayWhatIsWrong) {
  TrainOptions options;
  EXPECT_TRUE(options.Validate().ok());
  options.session = 32;
  EXPECT_THAT(options.Validate().message(), HasSubstr("session"));
  options = {};
  options.max_keyframes = 1;
  EXPECT_THAT(options.Validate().message(), HasSubstr("max_keyframes"));
}

}  // namespace
}  // namespace lararium::train
