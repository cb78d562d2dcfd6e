#include "shared/capture/looped_source.h"

#include <utility>

namespace lararium::capture {
namespace {

using geometry::Frame;

class LoopedSource final : public FrameSource {
 public:
  explicit LoopedSource(std::unique_ptr<FrameSource> recording)
      : recording_(std::move(recording)) {}

  Result<std::optional<Frame>> Next() override {
    LARARIUM_ASSIGN_OR_RETURN(std::optional<Frame> frame, recording_->Next());
    if (!frame && round_ > 0) {
      LARARIUM_RETURN_IF_ERROR(recording_->Seek(0));
      first_index_ += round_;
      first_time_ = last_time_ + 1.0 / frames_per_second() - begin_;
      round_ = 0;
      LARARIUM_ASSIGN_OR_RETURN(frame, recording_->Next());
    }
    if (!frame) {
      return frame;
    }
    if (round_ == 0 && first_index_ == 0) {
      begin_ = frame->capture_time;
    }
    ++round_;
    frame->index += first_index_;
    frame->capture_time += first_time_;
    last_time_ = frame->capture_time;
    return frame;
  }

  Status Seek(int64_t index) override {
    first_index_ = 0;
    first_time_ = 0.0;
    return recording_->Seek(index);
  }
  std::optional<int64_t> frame_count() const override { return std::nullopt; }
  int width() const override { return recording_->width(); }
  int height() const override { return recording_->height(); }
  double frames_per_second() const override { return recording_->frames_per_second(); }
  bool live() const override { return recording_->live(); }
  std::string FrameName(int64_t index) const override { return NumberedFrameName(index); }

 private:
  std::unique_ptr<FrameSource> recording_;
  int64_t first_index_ = 0;  // of this round
  double first_time_ = 0.0;  // what is added to its times
  int64_t round_ = 0;        // frames of it so far
  double begin_ = 0.0;       // of the recording's own times
  double last_time_ = 0.0;
};

}  // namespace

std::unique_ptr<FrameSource> Loop(std::unique_ptr<FrameSource> recording) {
  return std::make_unique<LoopedSource>(std::move(recording));
}

}  // namespace lararium::capture
