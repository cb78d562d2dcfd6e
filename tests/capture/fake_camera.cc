#include "tests/capture/fake_camera.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstdlib>

namespace lararium::capture {
namespace {

constexpr uint32_t kCapture = V4L2_BUF_TYPE_VIDEO_CAPTURE;

int Fail(int error) {
  errno = error;
  return -1;
}

uint32_t BytesPerPixel(uint32_t format) {
  switch (format) {
    case V4L2_PIX_FMT_YUYV:
    case V4L2_PIX_FMT_UYVY:
    case V4L2_PIX_FMT_YVYU:
      return 2;
    case V4L2_PIX_FMT_NV12:
    case V4L2_PIX_FMT_SGRBG8:
      return 1;
    default:
      return 0;  // compressed
  }
}

class FakeDevice final : public VideoDevice {
 public:
  explicit FakeDevice(FakeCamera& camera) : camera_(camera) { camera_.calls = 0; }

  int Ioctl(unsigned long request, void* argument) override {
    if (camera_.interruptions > 0) {
      --camera_.interruptions;
      return Fail(EINTR);
    }
    if (camera_.unplugged) {
      return Fail(ENODEV);
    }
    if (camera_.calls++ == camera_.failing_call) {
      return Fail(EIO);
    }
    const int error = Answer(request, argument);
    return error == 0 ? 0 : Fail(error);
  }

  uint8_t* Map(size_t length, int64_t offset) override {
    const size_t index = static_cast<size_t>(offset) / kPage;
    if (camera_.calls++ == camera_.failing_call || index >= camera_.buffers.size() ||
        length != camera_.buffers[index].size()) {
      errno = EINVAL;
      return nullptr;
    }
    ++camera_.mapped;
    return camera_.buffers[index].data();
  }

  void Unmap(uint8_t*, size_t) override { --camera_.mapped; }

  int Wait(int) override {
    if (camera_.interruptions > 0) {
      --camera_.interruptions;
      return Fail(EINTR);
    }
    if (camera_.filled.empty() && !camera_.unplugged) {
      if (!camera_.coming.empty()) {
        camera_.Send(camera_.coming.front());
        camera_.coming.pop_front();
      } else if (camera_.when_waited) {
        camera_.Send(camera_.when_waited());
      }
    }
    return camera_.unplugged || !camera_.filled.empty() ? 1 : 0;
  }

  int descriptor() const override { return -1; }

 private:
  static constexpr size_t kPage = 4096;

  int Answer(unsigned long request, void* argument) {
    switch (request) {
      case VIDIOC_QUERYCAP:
        return Describe(*static_cast<v4l2_capability*>(argument));
      case VIDIOC_ENUM_FMT:
        return Enumerate(*static_cast<v4l2_fmtdesc*>(argument));
      case VIDIOC_ENUM_FRAMESIZES:
        return Enumerate(*static_cast<v4l2_frmsizeenum*>(argument));
      case VIDIOC_TRY_FMT:
        return Round(*static_cast<v4l2_format*>(argument));
      case VIDIOC_S_FMT:
        return Set(*static_cast<v4l2_format*>(argument));
      case VIDIOC_S_PARM:
        return Set(*static_cast<v4l2_streamparm*>(argument));
      case VIDIOC_S_CTRL:
        return Set(*static_cast<v4l2_control*>(argument));
      case VIDIOC_REQBUFS:
        return Allocate(*static_cast<v4l2_requestbuffers*>(argument));
      case VIDIOC_QUERYBUF:
        return Query(*static_cast<v4l2_buffer*>(argument));
      case VIDIOC_QBUF:
        return Queue(*static_cast<v4l2_buffer*>(argument));
      case VIDIOC_DQBUF:
        return Dequeue(*static_cast<v4l2_buffer*>(argument));
      case VIDIOC_STREAMON:
        return Stream(*static_cast<uint32_t*>(argument), true);
      case VIDIOC_STREAMOFF:
        return Stream(*static_cast<uint32_t*>(argument), false);
      default:
        return ENOTTY;
    }
  }

  int Describe(v4l2_capability& capability) {
    capability = Zeroed<v4l2_capability>();
    std::copy(camera_.driver.begin(), camera_.driver.end(), capability.driver);
    std::copy(camera_.card.begin(), camera_.card.end(), capability.card);
    // Capabilities of all nodes of the camera together, and of this one.
    capability.capabilities =
        V4L2_CAP_DEVICE_CAPS | V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_STREAMING | V4L2_CAP_META_CAPTURE;
    capability.device_caps = camera_.capabilities;
    return 0;
  }

  int Enumerate(v4l2_fmtdesc& format) {
    if (format.type != kCapture || format.index >= camera_.modes.size()) {
      return EINVAL;
    }
    format.pixelformat = camera_.modes[format.index].format;
    return 0;
  }

  int Enumerate(v4l2_frmsizeenum& size) {
    for (const FakeCamera::Mode& mode : camera_.modes) {
      if (mode.format == size.pixel_format && size.index < mode.sizes.size()) {
        size.type = V4L2_FRMSIZE_TYPE_DISCRETE;
        size.discrete = {mode.sizes[size.index].first, mode.sizes[size.index].second};
        return 0;
      }
    }
    return EINVAL;
  }

  // Rounds to the nearest size of the format; an unknown format becomes the first one.
  int Round(v4l2_format& format) {
    if (format.type != kCapture) {
      return EINVAL;
    }
    v4l2_pix_format& pixels = format.fmt.pix;
    const auto mode =
        std::find_if(camera_.modes.begin(), camera_.modes.end(),
                     [&](const FakeCamera::Mode& m) { return m.format == pixels.pixelformat; });
    const FakeCamera::Mode& its = mode == camera_.modes.end() ? camera_.modes.front() : *mode;
    const auto distance = [&](const std::pair<uint32_t, uint32_t>& size) {
      return std::hypot(double{1.0} * size.first - pixels.width,
                        double{1.0} * size.second - pixels.height);
    };
    const auto nearest =
        *std::min_element(its.sizes.begin(), its.sizes.end(),
                          [&](const auto& a, const auto& b) { return distance(a) < distance(b); });
    pixels = Zeroed<v4l2_pix_format>();
    pixels.width = nearest.first;
    pixels.height = nearest.second;
    pixels.pixelformat = its.format;
    pixels.field = V4L2_FIELD_NONE;
    const uint32_t bytes = BytesPerPixel(its.format);
    pixels.bytesperline = bytes == 0 ? 0 : bytes * nearest.first + camera_.padding;
    const uint32_t lines =
        its.format == V4L2_PIX_FMT_NV12 ? nearest.second * 3 / 2 : nearest.second;
    pixels.sizeimage =
        bytes == 0 ? 3 * nearest.first * nearest.second : pixels.bytesperline * lines;
    return 0;
  }

  int Set(v4l2_format& format) {
    if (camera_.busy || !camera_.buffers.empty()) {
      return EBUSY;
    }
    const int error = Round(format);
    camera_.format = format.fmt.pix;
    return error;
  }

  int Set(v4l2_streamparm& parameters) {
    if (!camera_.knows_rates) {
      return ENOTTY;
    }
    if (parameters.type != kCapture || !camera_.buffers.empty()) {
      return EINVAL;
    }
    v4l2_fract& interval = parameters.parm.capture.timeperframe;
    const double wanted = double{1.0} * interval.denominator / interval.numerator;
    const auto distance = [&](uint32_t rate) { return std::abs(rate - wanted); };
    interval = {
        1, *std::min_element(camera_.rates.begin(), camera_.rates.end(),
                             [&](uint32_t a, uint32_t b) { return distance(a) < distance(b); })};
    parameters.parm.capture.capability = V4L2_CAP_TIMEPERFRAME;
    return 0;
  }

  int Set(const v4l2_control& control) {
    const auto found = camera_.controls.find(control.id);
    if (found == camera_.controls.end()) {
      return EINVAL;
    }
    found->second = control.value;
    return 0;
  }

  int Allocate(v4l2_requestbuffers& request) {
    if (request.type != kCapture || request.memory != V4L2_MEMORY_MMAP) {
      return EINVAL;
    }
    if (camera_.busy || camera_.streams || camera_.mapped > 0) {
      return EBUSY;
    }
    camera_.queued.clear();
    camera_.filled.clear();
    request.count = std::min(request.count, 32u);
    camera_.buffers.assign(request.count, std::vector<uint8_t>(camera_.format.sizeimage));
    return 0;
  }

  int Query(v4l2_buffer& buffer) {
    if (buffer.index >= camera_.buffers.size()) {
      return EINVAL;
    }
    buffer.length = static_cast<uint32_t>(camera_.buffers[buffer.index].size());
    buffer.m.offset = static_cast<uint32_t>(buffer.index * kPage);
    return 0;
  }

  int Queue(const v4l2_buffer& buffer) {
    const bool has_it =
        std::count(camera_.queued.begin(), camera_.queued.end(), buffer.index) > 0 ||
        std::any_of(camera_.filled.begin(), camera_.filled.end(),
                    [&](const v4l2_buffer& b) { return b.index == buffer.index; });
    if (buffer.index >= camera_.buffers.size() || has_it) {
      return EINVAL;
    }
    camera_.queued.push_back(buffer.index);
    return 0;
  }

  int Dequeue(v4l2_buffer& buffer) {
    if (!camera_.streams || buffer.type != kCapture || buffer.memory != V4L2_MEMORY_MMAP) {
      return EINVAL;
    }
    if (camera_.filled.empty()) {
      return EAGAIN;
    }
    buffer = camera_.filled.front();
    camera_.filled.pop_front();
    return 0;
  }

  int Stream(uint32_t type, bool on) {
    if (type != kCapture || (on && camera_.queued.empty())) {
      return EINVAL;
    }
    camera_.streams = on;
    if (!on) {
      camera_.queued.clear();
      camera_.filled.clear();
    }
    return 0;
  }

  FakeCamera& camera_;
};

}  // namespace

void FakeCamera::Send(const Sent& sent) {
  if (!streams || queued.empty()) {
    ++lost;
    return;
  }
  v4l2_buffer buffer = Zeroed<v4l2_buffer>();
  buffer.type = kCapture;
  buffer.memory = V4L2_MEMORY_MMAP;
  buffer.index = queued.front();
  queued.pop_front();
  std::vector<uint8_t>& memory = buffers[buffer.index];
  const size_t used = std::min(sent.bytes.size(), memory.size());
  std::copy_n(sent.bytes.begin(), used, memory.begin());
  buffer.bytesused = static_cast<uint32_t>(used);
  buffer.flags = sent.flags;
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  const auto taken = std::chrono::duration_cast<std::chrono::microseconds>(now) -
                     std::chrono::microseconds(std::llround(1e6 * sent.age));
  buffer.timestamp.tv_sec = taken.count() / 1'000'000;
  buffer.timestamp.tv_usec = taken.count() % 1'000'000;
  filled.push_back(buffer);
}

std::unique_ptr<VideoDevice> FakeCamera::Open() {
  // Disables the controls that libv4lconvert adds: it would keep them in shared memory beyond the
  // test.
  setenv("LIBV4LCONTROL_CONTROLS", "0", 1);
  return std::make_unique<FakeDevice>(*this);
}

}  // namespace lararium::capture
