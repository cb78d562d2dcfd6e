#pragma once

// The image buffers that are shared with a camera's driver. Private to capture.

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
  std::span<uint8_t> bytes;     // Valid until GiveBack().
  std::optional<double> taken;  // Seconds of std::chrono::steady_clock, if the driver provides it.
};

class BufferQueue {
 public:
  // Starts the stream of images, which runs until the queue is destroyed. device must outlive the
  // queue.
  static Result<std::unique_ptr<BufferQueue>> Start(const std::string& name, VideoDevice& device);
  ~BufferQueue();
  BufferQueue(const BufferQueue&) = delete;
  BufferQueue& operator=(const BufferQueue&) = delete;

  // Returns the newest image, so that the caller never falls behind. Older images, and images that
  // the driver marks as damaged, are returned to the driver. Waits for up to two seconds, for the
  // first image up to five.
  Result<SentImage> Newest();
  // Returns the image's buffer to the driver.
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
  bool came_ = false;  // True after the first image.
};

}  // namespace lararium::capture
