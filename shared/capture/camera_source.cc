#include "shared/capture/camera_source.h"

#include <algorithm>
#include <chrono>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "shared/capture/buffer_queue.h"
#include "shared/capture/camera_setup.h"
#include "shared/capture/frame_converter.h"
#include "shared/geometry/frame_pool.h"

namespace lararium::capture {
namespace {

using geometry::Frame;

constexpr int kMostDamaged = 30;  // consecutive images
constexpr double kOldest = 0.5;   // Seconds; an older time from the driver is wrong.
constexpr double kLeastStep = 1e-3;

double Now() {
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration<double>(now).count();
}

class CameraSource final : public FrameSource {
 public:
  CameraSource(std::string name,
               std::unique_ptr<VideoDevice> device,
               FrameConverter converter,
               const CameraMode& mode,
               std::unique_ptr<BufferQueue> queue)
      : name_(std::move(name)),
        device_(std::move(device)),
        converter_(std::move(converter)),
        mode_(mode),
        queue_(std::move(queue)) {}

  Result<std::optional<Frame>> Next() override {
    Frame frame;
    frame.bgr = pool_.Take(height(), width(), CV_8UC3);
    frame.grey = pool_.Take(height(), width(), CV_8UC1);
    for (int damaged = 0; damaged < kMostDamaged; ++damaged) {
      LARARIUM_ASSIGN_OR_RETURN(const SentImage image, queue_->Newest());
      const double time = TimeOf(image);
      const bool converted = converter_.Convert(mode_.format, image.bytes, frame.bgr);
      queue_->GiveBack(image);
      if (converted) {
        cv::cvtColor(frame.bgr, frame.grey, cv::COLOR_BGR2GRAY);
        frame.capture_time = last_time_ = std::max(time, last_time_ + kLeastStep);
        frame.index = next_index_++;
        return std::optional<Frame>(std::move(frame));
      }
    }
    return Status::Error(name_, "gives no image that can be read (" + converter_.Problem() + ")",
                         "check its cable, or change the device file's \"capture\"");
  }

  Status Seek(int64_t) override { return Status::Error(name_, "a live camera cannot seek"); }

  std::optional<int64_t> frame_count() const override { return std::nullopt; }
  int width() const override { return static_cast<int>(mode_.format.fmt.pix.width); }
  int height() const override { return static_cast<int>(mode_.format.fmt.pix.height); }
  double frames_per_second() const override { return mode_.frames_per_second; }
  bool live() const override { return true; }
  std::string FrameName(int64_t index) const override { return NumberedFrameName(index); }

 private:
  // Seconds since the camera was opened. The driver knows when an image was taken; we only know
  // when it arrived.
  double TimeOf(const SentImage& image) const {
    const double now = Now();
    const double taken = image.taken.value_or(now);
    return (taken <= now && taken >= now - kOldest ? taken : now) - start_;
  }

  std::string name_;
  // Each member uses those above it.
  std::unique_ptr<VideoDevice> device_;
  FrameConverter converter_;
  CameraMode mode_;
  std::unique_ptr<BufferQueue> queue_;
  geometry::FramePool pool_;
  double start_ = Now();
  double last_time_ = -kLeastStep;
  int64_t next_index_ = 0;
};

}  // namespace

Result<std::unique_ptr<FrameSource>> OpenCamera(const std::string& name,
                                                std::unique_ptr<VideoDevice> device,
                                                const CameraSettings& settings) {
  LARARIUM_RETURN_IF_ERROR(CameraName(name, *device).status());
  LARARIUM_ASSIGN_OR_RETURN(FrameConverter converter, FrameConverter::Create(name, *device));
  LARARIUM_ASSIGN_OR_RETURN(const CameraMode mode, SetUpCamera(name, settings, *device, converter));
  LARARIUM_ASSIGN_OR_RETURN(std::unique_ptr<BufferQueue> queue, BufferQueue::Start(name, *device));
  return std::unique_ptr<FrameSource>(std::make_unique<CameraSource>(
      name, std::move(device), std::move(converter), mode, std::move(queue)));
}

Result<std::unique_ptr<FrameSource>> OpenCamera(int number, const CameraSettings& settings) {
  const std::string name = "camera " + std::to_string(number);
  LARARIUM_ASSIGN_OR_RETURN(std::unique_ptr<VideoDevice> device, OpenVideoDevice(name, number));
  return OpenCamera(name, std::move(device), settings);
}

}  // namespace lararium::capture
