#include "tests/train/part_of_video.h"

#include <gtest/gtest.h>

#include <utility>

namespace lararium::train {
namespace {

class PartOfVideo : public capture::FrameSource {
 public:
  PartOfVideo(std::unique_ptr<FrameSource> video, const Part& part)
      : video_(std::move(video)), part_(part) {}

  Result<std::optional<geometry::Frame>> Next() override {
    while (true) {
      auto frame = video_->Next();
      if (!frame.ok() || !*frame) {
        return frame;
      }
      const int64_t index = (*frame)->index;
      if (index > part_.last) {
        return std::optional<geometry::Frame>();
      }
      if (index >= part_.first && (index - part_.first) % part_.step == 0) {
        return frame;
      }
    }
  }
  Status Seek(int64_t index) override { return video_->Seek(index); }
  std::optional<int64_t> frame_count() const override {
    return (part_.last - part_.first) / part_.step + 1;
  }
  int width() const override { return video_->width(); }
  int height() const override { return video_->height(); }
  double frames_per_second() const override { return video_->frames_per_second(); }
  bool live() const override { return false; }
  std::string FrameName(int64_t index) const override { return video_->FrameName(index); }

 private:
  std::unique_ptr<FrameSource> video_;
  Part part_;
};

}  // namespace

std::unique_ptr<capture::FrameSource> Part::Open() const {
  auto source = capture::OpenVideo(video);
  EXPECT_TRUE(source.ok());
  return std::make_unique<PartOfVideo>(std::move(*source), *this);
}

}  // namespace lararium::train
