#pragma once

// The buffers that a camera's driver fills with images, shared with it. Private to capture.

#include <linux/videodev2.h>

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "shared/capture/video_device.h"
#include "shared/core/status.h"

namespace lararium::capture {

// An image as the camera sent it.
struct SentImage {
  uint32_t buffer = 0;
  std::span<uint8_t> bytes;     // until it is given back
  std::optional<double> taken;  // seconds of std::chrono::steady_clock, where the driver knows
};

class BufferQueue {
 public:
  // Images flow from now on until it goes away. device must outlive it.
  static Result<std::unique_ptr<BufferQueue>> Start(const std::string& name, VideoDevice& device);
  ~BufferQueue();
  BufferQueue(const BufferQueue&) = delete;
  BufferQueue& operator=(const BufferQueue&) = delete;

  // The newest image, so that nobody lags behind: older ones, and those that the driver knows to
  // be damaged, go back. Waits for one up to two seconds, for the first one five.
  Result<SentImage> Newest();
  // The driver may fill its buffer again.
  void GiveBack(const SentImage& image);

 private:
  using Clock = std::chrono::steady_clock;

  BufferQueue(std::string name, VideoDevice& device) : name_(std::move(name)), device_(device) {}
  Status Allocate();
  Status Share(uint32_t index);
  Status Flow();
  bool WaitUntil(Clock::time_point deadline);
  Result<std::optional<v4l2_buffer>> Fetch();
  Result<std::optional<SentImage>> Drain(bool may_be_old);
  bool Queue(uint32_t index);

  std::string name_;
  VideoDevice& device_;
  std::vector<std::span<uint8_t>> buffers_;
  bool flows_ = false;
  bool came_ = false;  // an image
};

}  // namespace lararium::capture
