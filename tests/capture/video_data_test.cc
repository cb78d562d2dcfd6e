#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "shared/capture/frame_source.h"
#include "tests/support/test_files.h"

namespace lararium::capture {
namespace {

std::unique_ptr<FrameSource> Open(const std::filesystem::path& file) {
  auto source = OpenVideo(file);
  EXPECT_TRUE(source.ok()) << source.message();
  return std::move(source).value();
}

int64_t CountFrames(FrameSource& source) {
  int64_t count = 0;
  while (true) {
    const auto frame = source.Next();
    EXPECT_TRUE(frame.ok()) << frame.message();
    if (!frame.ok() || !frame->has_value()) {
      return count;
    }
    EXPECT_EQ((*frame)->index, count);
    ++count;
  }
}

// Decodes in order, then reads frames from the end to the start by seeking.
void ExpectSeekEqualsSequence(const std::filesystem::path& file, int64_t step) {
  const auto sequential = Open(file);
  std::vector<cv::Mat> images;
  while (auto frame = std::move(sequential->Next()).value()) {
    images.push_back(frame->bgr);
  }
  for (int64_t i = static_cast<int64_t>(images.size()) - 1; i >= 0; i -= step) {
    ASSERT_TRUE(sequential->Seek(i).ok());
    const auto frame = std::move(sequential->Next()).value();
    ASSERT_TRUE(frame.has_value());
    ASSERT_EQ(frame->index, i);
    ASSERT_EQ(cv::norm(frame->bgr, images[i], cv::NORM_INF), 0.0) << "frame " << i;
  }
}

TEST(VideoData, CountsTheFramesThatDecodeWhereTheContainerMiscounts) {
  LARARIUM_REQUIRE_DATA(folder, "box");
  const auto source = Open(folder / "box.mp4");
  EXPECT_EQ(CountFrames(*source), 455);
  EXPECT_EQ(source->frame_count(), 455);
}

TEST(VideoData, SeekEqualsSequentialDecodingOfABrokenStart) {
  LARARIUM_REQUIRE_DATA(folder, "box");
  ExpectSeekEqualsSequence(folder / "box.mp4", 37);
}

TEST(VideoData, SeekEqualsSequentialDecoding) {
  LARARIUM_REQUIRE_DATA(folder, "maquette");
  ExpectSeekEqualsSequence(folder / "occlusion" / "video.mp4", 7);
}

TEST(VideoData, ReadsEveryMaquetteSequence) {
  LARARIUM_REQUIRE_DATA(folder, "maquette");
  EXPECT_EQ(CountFrames(*Open(folder / "training" / "video.mp4")), 120);
  EXPECT_EQ(CountFrames(*Open(folder / "handheld" / "video.mp4")), 150);
}

}  // namespace
}  // namespace lararium::capture
