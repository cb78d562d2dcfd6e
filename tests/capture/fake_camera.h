#pragma once

// A Video4Linux driver without hardware. It answers and refuses as the interface's specification
// says. https://docs.kernel.org/userspace-api/media/v4l/v4l2.html

#include <linux/videodev2.h>

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "shared/capture/video_device.h"

namespace lararium::capture {

// The camera's behaviour as set by a test, and its record of calls. It must outlive the device.
struct FakeCamera {
  struct Mode {
    uint32_t format = V4L2_PIX_FMT_YUYV;
    std::vector<std::pair<uint32_t, uint32_t>> sizes = {{640, 480}};
  };
  struct Sent {
    std::vector<uint8_t> bytes;
    uint32_t flags = V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC;
    double age = 0.0;  // Age in seconds according to its time stamp.
  };

  std::string driver = "fake";
  std::string card = "Fake camera";  // no more than 32 bytes
  std::vector<Mode> modes = {{}};
  uint32_t capabilities = V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_STREAMING;
  std::vector<uint32_t> rates = {30};
  bool knows_rates = true;
  std::map<uint32_t, int> controls;  // key: control id
  uint32_t padding = 0;              // bytes after each line
  // Behaviour.
  bool unplugged = false;
  bool busy = false;                  // Another program uses the camera.
  int interruptions = 0;              // Number of calls that a signal interrupts.
  int failing_call = -1;              // Number of the call that fails, counted since opening.
  std::deque<Sent> coming;            // Next images; each is sent when the program waits for one.
  std::function<Sent()> when_waited;  // Creates the images after `coming`.
  // Record of calls.
  int calls = 0;
  v4l2_pix_format format = {};
  bool streams = false;
  size_t mapped = 0;
  size_t lost = 0;  // Images lost because there was no free buffer.
  std::vector<std::vector<uint8_t>> buffers;

  // Delivers an image.
  void Send(const Sent& sent);

  std::unique_ptr<VideoDevice> Open();

  // Queues of buffers.
  std::deque<uint32_t> queued;
  std::deque<v4l2_buffer> filled;
};

}  // namespace lararium::capture
