#include <chrono>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>

#include "shared/capture/frame_pool.h"
#include "shared/capture/frame_source.h"

namespace lararium::capture {
namespace {

using geometry::Frame;
using Clock = std::chrono::steady_clock;

class CameraSource final : public FrameSource {
 public:
  CameraSource(std::string name, cv::VideoCapture capture)
      : name_(std::move(name)), capture_(std::move(capture)), start_(Clock::now()) {
    width_ = static_cast<int>(capture_.get(cv::CAP_PROP_FRAME_WIDTH));
    height_ = static_cast<int>(capture_.get(cv::CAP_PROP_FRAME_HEIGHT));
    const double rate = capture_.get(cv::CAP_PROP_FPS);
    frames_per_second_ = rate > 0.1 && rate < 1000.0 ? rate : 30.0;
  }

  Result<std::optional<Frame>> Next() override {
    Frame frame;
    frame.bgr = pool_.Take(height_, width_, CV_8UC3);
    frame.grey = pool_.Take(height_, width_, CV_8UC1);
    if (!Read(frame)) {
      return Status::Error(name_, "gives no image", "check that it is connected");
    }
    if (frame.bgr.cols != width_ || frame.bgr.rows != height_ || frame.bgr.type() != CV_8UC3) {
      return Status::Error(name_, "changed its image size or format", "open it again");
    }
    frame.index = next_index_++;
    cv::cvtColor(frame.bgr, frame.grey, cv::COLOR_BGR2GRAY);
    return std::optional<Frame>(std::move(frame));
  }

  Status Seek(int64_t) override { return Status::Error(name_, "a live camera cannot seek"); }

  std::optional<int64_t> frame_count() const override { return std::nullopt; }
  int width() const override { return width_; }
  int height() const override { return height_; }
  double frames_per_second() const override { return frames_per_second_; }
  bool live() const override { return true; }
  std::string FrameName(int64_t index) const override { return NumberedFrameName(index); }

 private:
  bool Read(Frame& frame) {
    try {
      if (!capture_.grab()) {
        return false;
      }
      frame.capture_time = std::chrono::duration<double>(Clock::now() - start_).count();
      return capture_.retrieve(frame.bgr);
    } catch (const cv::Exception&) {
      return false;
    }
  }

  std::string name_;
  cv::VideoCapture capture_;
  Clock::time_point start_;
  FramePool pool_;
  int width_ = 0;
  int height_ = 0;
  double frames_per_second_ = 30.0;
  int64_t next_index_ = 0;
};

// Sizes and formats belong together: first the format, then the size, then the rate.
Status Configure(const std::string& name,
                 const CameraSettings& settings,
                 cv::VideoCapture& capture) {
  if (settings.format.size() == 4) {
    const std::string& f = settings.format;
    capture.set(cv::CAP_PROP_FOURCC, cv::VideoWriter::fourcc(f[0], f[1], f[2], f[3]));
  }
  if (settings.width > 0 && settings.height > 0) {
    capture.set(cv::CAP_PROP_FRAME_WIDTH, settings.width);
    capture.set(cv::CAP_PROP_FRAME_HEIGHT, settings.height);
    if (static_cast<int>(capture.get(cv::CAP_PROP_FRAME_WIDTH)) != settings.width ||
        static_cast<int>(capture.get(cv::CAP_PROP_FRAME_HEIGHT)) != settings.height) {
      return Status::Error(name,
                           "has no images of " + std::to_string(settings.width) + "x" +
                               std::to_string(settings.height),
                           "change the device file's \"capture\"");
    }
  }
  if (settings.frames_per_second > 0.0) {
    capture.set(cv::CAP_PROP_FPS, settings.frames_per_second);
  }
  if (settings.exposure_ms) {
    // V4L2: 1 is by hand; exposure counts in tenths of a millisecond.
    capture.set(cv::CAP_PROP_AUTO_EXPOSURE, 1.0);
    capture.set(cv::CAP_PROP_EXPOSURE, 10.0 * *settings.exposure_ms);
  }
  return Status();
}

}  // namespace

Result<std::unique_ptr<FrameSource>> OpenCamera(int number, const CameraSettings& settings) {
  const std::string name = "camera " + std::to_string(number);
  cv::VideoCapture capture;
  bool opened = false;
  try {
    // OpenCV prints about devices that do not exist.
    opened = number >= 0 && std::filesystem::exists("/dev/video" + std::to_string(number)) &&
             capture.open(number, cv::CAP_V4L2);
  } catch (const std::exception&) {
    opened = false;
  }
  if (!opened) {
    return Status::Error(name, "cannot be opened", "check that it is connected and not in use");
  }
  LARARIUM_RETURN_IF_ERROR(Configure(name, settings, capture));
  return std::unique_ptr<FrameSource>(std::make_unique<CameraSource>(name, std::move(capture)));
}

}  // namespace lararium::capture
