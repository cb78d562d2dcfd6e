#include "shared/capture/steady_camera.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>
#include <utility>

#include "shared/geometry/frame_pool.h"

namespace lararium::capture {
namespace {

using geometry::Frame;

constexpr double kMostClockError = 0.5;  // seconds
constexpr double kLeastStreamStep = 1e-3;

class SteadyCamera final : public FrameSource {
 public:
  SteadyCamera(std::unique_ptr<FrameSource> camera,
               SteadyCameraWorld world,
               const SteadyCameraOptions& options)
      : camera_(std::move(camera)),
        world_(std::move(world)),
        options_(options),
        width_(camera_->width()),
        height_(camera_->height()),
        frames_per_second_(camera_->frames_per_second()) {}

  // Never returns an error and never ends.
  Result<std::optional<Frame>> Next() override {
    const double now = world_.now();
    start_ = start_.value_or(now);
    if (camera_ == nullptr && now >= next_attempt_) {
      TryToOpen();
    }
    if (camera_ != nullptr) {
      Result<std::optional<Frame>> frame = camera_->Next();
      if (frame.ok() && frame->has_value()) {
        const double time = OurTime((*frame)->capture_time);
        return std::optional<Frame>(Numbered(std::move(**frame), time));
      }
      Lose(frame.ok() ? "it gives no more images" : frame.message());
    }
    world_.sleep(1.0 / options_.black_rate);
    return std::optional<Frame>(Numbered(Black(), world_.now() - *start_));
  }

  Status Seek(int64_t) override { return Status::Error("camera", "a live camera cannot seek"); }
  std::optional<int64_t> frame_count() const override { return std::nullopt; }
  int width() const override { return width_; }
  int height() const override { return height_; }
  double frames_per_second() const override { return frames_per_second_; }
  bool live() const override { return true; }
  std::string FrameName(int64_t index) const override { return NumberedFrameName(index); }

 private:
  void Lose(const std::string& why) {
    camera_.reset();
    told_of_size_ = false;
    next_attempt_ = world_.now() + options_.retry_seconds;
    world_.changed(false, why);
  }

  void TryToOpen() {
    Result<std::unique_ptr<FrameSource>> opened = world_.open();
    next_attempt_ = world_.now() + options_.retry_seconds;
    if (!opened.ok()) {
      return;
    }
    if ((*opened)->width() != width_ || (*opened)->height() != height_) {
      if (!std::exchange(told_of_size_, true)) {
        world_.changed(false, "the camera came back with " + SizeOf(**opened) +
                                  " pixels instead of " + SizeOf(*this) +
                                  "; restore its former mode, or restart the program");
      }
      return;
    }
    camera_ = std::move(*opened);
    ours_from_theirs_.reset();
    world_.changed(true, "");
  }

  static std::string SizeOf(const FrameSource& source) {
    return std::to_string(source.width()) + "x" + std::to_string(source.height());
  }

  // The camera's clock tells best when an image was taken, but it restarts with each opening and
  // may jump.
  double OurTime(double theirs) {
    const double now = world_.now() - *start_;
    const double leap = ours_from_theirs_ ? theirs + *ours_from_theirs_ - now : 0.0;
    const bool leaps = std::abs(leap) > kMostClockError;
    if (!ours_from_theirs_ || leaps) {
      ours_from_theirs_ = now - theirs;
    }
    WatchClock(now, leaps, leap);
    return theirs + *ours_from_theirs_;
  }

  // Reports only the first jump, because a clock may jump with every image.
  void WatchClock(double now, bool leaps, double leap) {
    const bool was_steady = clock_steady_;
    last_leap_ = leaps ? now : last_leap_;
    clock_steady_ = !leaps && (was_steady || now - last_leap_ > options_.steady_clock);
    if (clock_steady_ != was_steady && world_.clock_changed) {
      world_.clock_changed(clock_steady_, leap);
    }
  }

  // Time always increases.
  Frame Numbered(Frame frame, double time) {
    frame.index = next_index_++;
    frame.capture_time = last_time_ = std::max(time, last_time_ + kLeastStreamStep);
    return frame;
  }

  Frame Black() {
    Frame frame;
    frame.bgr = pool_.Take(height_, width_, CV_8UC3);
    frame.grey = pool_.Take(height_, width_, CV_8UC1);
    frame.bgr.setTo(0);
    frame.grey.setTo(0);
    return frame;
  }

  std::unique_ptr<FrameSource> camera_;  // nullptr while disconnected
  SteadyCameraWorld world_;
  SteadyCameraOptions options_;
  geometry::FramePool pool_;
  int width_ = 0;
  int height_ = 0;
  double frames_per_second_ = 30.0;
  int64_t next_index_ = 0;
  std::optional<double> start_;
  std::optional<double> ours_from_theirs_;
  bool clock_steady_ = true;
  double last_leap_ = 0.0;
  double last_time_ = -1.0;
  double next_attempt_ = 0.0;
  bool told_of_size_ = false;  // True if a wrong size was reported since the loss.
};

}  // namespace

std::unique_ptr<FrameSource> MakeSteady(std::unique_ptr<FrameSource> camera,
                                        SteadyCameraWorld world,
                                        const SteadyCameraOptions& options) {
  return std::make_unique<SteadyCamera>(std::move(camera), std::move(world), options);
}

SteadyCameraWorld RealWorld(std::function<Result<std::unique_ptr<FrameSource>>()> open,
                            std::function<void(bool, const std::string&)> changed,
                            std::function<void(bool, double)> clock_changed) {
  return {
      std::move(open),
      [] {
        const auto now = std::chrono::steady_clock::now().time_since_epoch();
        return std::chrono::duration<double>(now).count();
      },
      [](double seconds) { std::this_thread::sleep_for(std::chrono::duration<double>(seconds)); },
      std::move(changed), std::move(clock_changed)};
}

}  // namespace lararium::capture
