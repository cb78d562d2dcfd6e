#include "editor/jobs/camera_measure.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "shared/core/random.h"

namespace lararium::editor {
namespace {

// Discs on grey with a camera's blur and noise; every second frame has motion blur.
class NoisyCamera : public capture::FrameSource {
 public:
  explicit NoisyCamera(int64_t count) : count_(count) {}

  Result<std::optional<geometry::Frame>> Next() override {
    if (next_ == count_) {
      return std::optional<geometry::Frame>();
    }
    constexpr int kFine = 4;
    Random random(static_cast<uint64_t>(next_) + 1);
    cv::Mat fine(kFine * height(), kFine * width(), CV_32FC3, cv::Scalar::all(0.5));
    for (int i = 0; i < 12; ++i) {
      const cv::Point centre{static_cast<int>(random.Uniform(0, fine.cols)),
                             static_cast<int>(random.Uniform(0, fine.rows))};
      const int radius = static_cast<int>(random.Uniform(80, 180));
      cv::circle(fine, centre, radius, cv::Scalar::all(random.Uniform(0.1, 0.9)), cv::FILLED);
    }
    cv::GaussianBlur(fine, fine, cv::Size(), kFine * (next_ % 2 == 0 ? kBlur : 4.0));
    cv::Mat image;
    cv::resize(fine, image, cv::Size(width(), height()), 0, 0, cv::INTER_AREA);
    image.forEach<cv::Vec3f>([&](cv::Vec3f& pixel, const int* at) {
      Random noise(static_cast<uint64_t>(next_), static_cast<uint64_t>(at[0] * 10000 + at[1]));
      for (int c = 0; c < 3; ++c) {
        pixel[c] += static_cast<float>(kNoise * noise.Normal());
      }
    });
    geometry::Frame frame;
    frame.index = next_++;
    image.convertTo(frame.bgr, CV_8UC3, 255.0);
    return std::optional<geometry::Frame>(frame);
  }
  Status Seek(int64_t index) override {
    next_ = index;
    return Status();
  }
  std::optional<int64_t> frame_count() const override { return count_; }
  int width() const override { return 240; }
  int height() const override { return 180; }
  double frames_per_second() const override { return 30.0; }
  bool live() const override { return false; }
  std::string FrameName(int64_t index) const override { return std::to_string(index); }

  static constexpr double kBlur = 0.8;
  static constexpr double kNoise = 0.015;

 private:
  int64_t count_;
  int64_t next_ = 0;
};

TEST(MeasureCamera, FindsNoiseAndTheBlurOfTheSharpestFrames) {
  NoisyCamera source(12);
  NoProgress progress;
  const auto traits = MeasureCamera(source, progress);
  ASSERT_TRUE(traits.ok()) << traits.message();
  EXPECT_EQ(traits->width, 240);
  EXPECT_NEAR(traits->blur_px, NoisyCamera::kBlur, 0.2);
  EXPECT_NEAR(std::sqrt(traits->noise_floor * traits->noise_floor + 0.5 * traits->noise_slope),
              NoisyCamera::kNoise, 0.003);
  EXPECT_FALSE(traits->shutter.has_value());
}

TEST(MeasureCamera, SaysWhatToDoWhereNothingCanBeSeen) {
  NoisyCamera source(0);
  NoProgress progress;
  const auto traits = MeasureCamera(source, progress);
  ASSERT_FALSE(traits.ok());
  EXPECT_NE(traits.message().find("good light"), std::string::npos);
}

TEST(CameraList, SaysNumberAndNameOrWhyThereIsNone) {
  const std::vector<capture::ConnectedCamera> cameras = {
      {0, "Integrated Camera", ""}, {2, "", "camera 2: cannot be opened (permission denied)"}};
  const CommandResult listed = CameraList(cameras);
  EXPECT_EQ(listed.text,
            "0  Integrated Camera\n2  camera 2: cannot be opened (permission denied)\n");
  EXPECT_EQ(listed.json["cameras"][0], Json({{"number", 0}, {"name", "Integrated Camera"}}));
  EXPECT_EQ(listed.json["cameras"][1]["problem"], cameras[1].problem);
  EXPECT_FALSE(listed.json["cameras"][1].contains("name"));
}

TEST(CameraList, WithoutCamerasItSaysSo) {
  const CommandResult listed = CameraList({});
  EXPECT_EQ(listed.text, "no camera is connected\n");
  EXPECT_TRUE(listed.json["cameras"].is_array() && listed.json["cameras"].empty());
}

}  // namespace
}  // namespace lararium::editor
