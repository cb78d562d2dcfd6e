#pragma once

// A driver of Video4Linux without hardware: it answers as the interface's specification says, and
// refuses what a driver refuses. https://docs.kernel.org/userspace-api/media/v4l/v4l2.html

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

// What a test tells the camera, and what it sees of it. Outlives the device.
struct FakeCamera {
  struct Mode {
    uint32_t format = V4L2_PIX_FMT_YUYV;
    std::vector<std::pair<uint32_t, uint32_t>> sizes = {{640, 480}};
  };
  struct Sent {
    std::vector<uint8_t> bytes;
    uint32_t flags = V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC;
    double age = 0.0;  // seconds, by its time stamp
  };

  std::string driver = "fake";
  std::string card = "Fake camera";  // at most 32 bytes
  std::vector<Mode> modes = {{}};
  uint32_t capabilities = V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_STREAMING;
  std::vector<uint32_t> rates = {30};
  bool knows_rates = true;
  std::map<uint32_t, int> controls;  // by their numbers
  uint32_t padding = 0;              // bytes behind each line
  // Behaviour.
  bool unplugged = false;
  bool busy = false;                  // another program has it
  int interruptions = 0;              // calls that a signal comes into
  int failing_call = -1;              // of those since it was opened: the one that fails
  std::deque<Sent> coming;            // what it sends next, each when somebody waits for it
  std::function<Sent()> when_waited;  // and then
  // What it saw.
  int calls = 0;
  v4l2_pix_format format = {};
  bool streams = false;
  size_t mapped = 0;
  size_t lost = 0;  // images that it had no buffer for
  std::vector<std::vector<uint8_t>> buffers;

  // An image arrives.
  void Send(const Sent& sent);

  std::unique_ptr<VideoDevice> Open();

  // Of buffers.
  std::deque<uint32_t> queued;
  std::deque<v4l2_buffer> filled;
};

}  // namespace lararium::capture
