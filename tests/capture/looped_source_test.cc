#include "shared/capture/looped_source.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

namespace lararium::capture {
namespace {

// Frames at 10 per second whose own times begin at 3.
class Recording final : public FrameSource {
 public:
  explicit Recording(int64_t count) : count_(count) {}
  Result<std::optional<geometry::Frame>> Next() override {
    if (next_ == count_) {
      return std::optional<geometry::Frame>();
    }
    geometry::Frame frame;
    frame.index = next_++;
    frame.capture_time = 3.0 + 0.1 * static_cast<double>(frame.index);
    frame.bgr = cv::Mat(2, 2, CV_8UC3, cv::Scalar::all(static_cast<double>(frame.index)));
    return std::optional(frame);
  }
  Status Seek(int64_t index) override {
    next_ = index;
    return Status();
  }
  std::optional<int64_t> frame_count() const override { return count_; }
  int width() const override { return 2; }
  int height() const override { return 2; }
  double frames_per_second() const override { return 10.0; }
  bool live() const override { return false; }
  std::string FrameName(int64_t index) const override { return NumberedFrameName(index); }

 private:
  int64_t count_;
  int64_t next_ = 0;
};

TEST(LoopedSource, GoesOnFromRoundToRoundWithoutAGap) {
  const auto source = Loop(std::make_unique<Recording>(7));
  for (int64_t i = 0; i < 50; ++i) {
    const geometry::Frame frame = **source->Next();
    EXPECT_EQ(frame.index, i);
    EXPECT_NEAR(frame.capture_time, 3.0 + 0.1 * static_cast<double>(i), 1e-9);
    EXPECT_EQ(frame.bgr.at<cv::Vec3b>(0, 0)[0], i % 7);
  }
  EXPECT_FALSE(source->frame_count());
}

TEST(LoopedSource, GoesOnFromWhereItWasSoughtTo) {
  const auto source = Loop(std::make_unique<Recording>(7));
  for (const int before : {0, 10}) {  // frames read first: none, or into the second round
    for (int i = 0; i < before; ++i) {
      (void)source->Next();
    }
    ASSERT_TRUE(source->Seek(4).ok());
    for (int64_t i = 4; i < 30; ++i) {
      const geometry::Frame frame = **source->Next();
      EXPECT_EQ(frame.index, i);
      EXPECT_NEAR(frame.capture_time, 3.0 + 0.1 * static_cast<double>(i), 1e-9);
      EXPECT_EQ(frame.bgr.at<cv::Vec3b>(0, 0)[0], i % 7);
    }
  }
}

TEST(LoopedSource, WithoutAFrameEndsAtOnce) {
  const auto source = Loop(std::make_unique<Recording>(0));
  EXPECT_FALSE((*source->Next()).has_value());
  EXPECT_FALSE((*source->Next()).has_value());
}

}  // namespace
}  // namespace lararium::capture
