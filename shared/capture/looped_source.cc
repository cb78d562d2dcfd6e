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
    if (!frame && last_index_ >= first_index_) {
      LARARIUM_RETURN_IF_ERROR(recording_->Seek(0));
      LARARIUM_ASSIGN_OR_RETURN(frame, recording_->Next());
      if (frame) {
        first_index_ = last_index_ + 1;
        first_time_ = last_time_ + 1.0 / frames_per_second() - frame->capture_time;
      }
    }
    if (!frame) {
      return frame;
    }
    frame->index += first_index_;
    frame->capture_time += first_time_;
    last_index_ = frame->index;
    last_time_ = frame->capture_time;
    return frame;
  }

  Status Seek(int64_t index) override {
    LARARIUM_RETURN_IF_ERROR(recording_->Seek(index));
    first_index_ = 0;
    first_time_ = 0.0;
    last_index_ = index - 1;
    return Status();
  }
  std::optional<int64_t> frame_count() const override { return std::nullopt; }
  int width() const override { return recording_->width(); }
  int height() const override { return recording_->height(); }
  double frames_per_second() const override { return recording_->frames_per_second(); }
  bool live() const override { return recording_->live(); }
  std::string FrameName(int64_t index) const override { return NumberedFrameName(index); }
  std::vector<std::string> Notes() const override { return recording_->Notes(); }

 private:
  std::unique_ptr<FrameSource> recording_;
  int64_t first_index_ = 0;  // index of this round's first frame
  double first_time_ = 0.0;  // offset added to this round's times
  int64_t last_index_ = -1;  // index of the last frame
  double last_time_ = 0.0;
};

}  // namespace

std::unique_ptr<FrameSource> Loop(std::unique_ptr<FrameSource> recording) {
  return std::make_unique<LoopedSource>(std::move(recording));
}

}  // namespace lararium::capture
