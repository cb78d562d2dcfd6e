#include "shared/capture/camera_setup.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <optional>
#include <system_error>

namespace lararium::capture {
namespace {

// Of a camera that was told nothing.
constexpr int kUsualWidth = 640;
constexpr int kUsualHeight = 480;
constexpr double kUsualRate = 30.0;

constexpr char kChangeCapture[] = "change the device file's \"capture\"";

bool HasSize(const CameraSettings& settings) { return settings.width > 0 && settings.height > 0; }

std::string SizeText(int64_t width, int64_t height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

// What to ask the driver for.
Result<v4l2_format> WantedFormat(const std::string& name,
                                 const CameraSettings& settings,
                                 FrameConverter& converter) {
  const int width = HasSize(settings) ? settings.width : kUsualWidth;
  const int height = HasSize(settings) ? settings.height : kUsualHeight;
  if (settings.format.size() == 4) {
    const std::string& f = settings.format;
    v4l2_format wanted = Zeroed<v4l2_format>();
    wanted.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    wanted.fmt.pix.width = static_cast<uint32_t>(width);
    wanted.fmt.pix.height = static_cast<uint32_t>(height);
    wanted.fmt.pix.pixelformat = v4l2_fourcc(f[0], f[1], f[2], f[3]);
    return wanted;
  }
  const double rate = settings.frames_per_second > 0.0 ? settings.frames_per_second : kUsualRate;
  const std::optional<v4l2_format> chosen = converter.Choose(width, height, rate);
  if (!chosen) {
    return Status::Error(name, "has no images of a format that is known", "take another camera");
  }
  return *chosen;
}

// A driver answers with what comes nearest.
Result<v4l2_format> SetFormat(const std::string& name,
                              const CameraSettings& settings,
                              VideoDevice& device,
                              FrameConverter& converter) {
  LARARIUM_ASSIGN_OR_RETURN(v4l2_format format, WantedFormat(name, settings, converter));
  const uint32_t wanted = format.fmt.pix.pixelformat;
  if (Ask(device, VIDIOC_S_FMT, &format) != 0) {
    return CannotOpen(name, "VIDIOC_S_FMT");
  }
  const v4l2_pix_format& given = format.fmt.pix;
  if (settings.format.size() == 4 && given.pixelformat != wanted) {
    return Status::Error(name, "has no images of the format " + settings.format, kChangeCapture);
  }
  if (HasSize(settings) && (given.width != static_cast<uint32_t>(settings.width) ||
                            given.height != static_cast<uint32_t>(settings.height))) {
    return Status::Error(name,
                         "has no images of " + SizeText(settings.width, settings.height) +
                             ", but of " + SizeText(given.width, given.height),
                         kChangeCapture);
  }
  if (given.width == 0 || given.height == 0) {
    errno = EINVAL;
    return CannotOpen(name, "VIDIOC_S_FMT");
  }
  return format;
}

// The rate that the driver grants, which need not be the one that was asked for.
double SetRate(const CameraSettings& settings, VideoDevice& device) {
  const double wanted = settings.frames_per_second > 0.0 ? settings.frames_per_second : kUsualRate;
  v4l2_streamparm parameters = Zeroed<v4l2_streamparm>();
  parameters.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  v4l2_fract& interval = parameters.parm.capture.timeperframe;
  const bool whole = wanted == std::floor(wanted);
  interval.numerator = whole ? 1 : 1000;
  interval.denominator = static_cast<uint32_t>(std::lround(wanted * interval.numerator));
  if (Ask(device, VIDIOC_S_PARM, &parameters) != 0 || interval.numerator == 0) {
    return kUsualRate;
  }
  const double rate = static_cast<double>(interval.denominator) / interval.numerator;
  return rate > 0.1 && rate < 1000.0 ? rate : kUsualRate;
}

bool SetControl(VideoDevice& device, uint32_t id, int value) {
  v4l2_control control = Zeroed<v4l2_control>();
  control.id = id;
  control.value = value;
  return Ask(device, VIDIOC_S_CTRL, &control) == 0;
}

Status NoExposure(const std::string& name, const char* control) {
  const std::string why = std::generic_category().message(errno);
  return Status::Error(
      name, std::string("does not let its exposure be set (") + control + ": " + why + ")",
      "remove \"exposure_ms\" from the device file's \"capture\"");
}

Status SetExposure(const std::string& name, double milliseconds, VideoDevice& device) {
  // A camera that never exposes by itself has no such switch.
  if (!SetControl(device, V4L2_CID_EXPOSURE_AUTO, V4L2_EXPOSURE_MANUAL) && errno != EINVAL) {
    return NoExposure(name, "V4L2_CID_EXPOSURE_AUTO");
  }
  // In tenths of a millisecond.
  const int tenths = std::max(1, static_cast<int>(std::lround(10.0 * milliseconds)));
  return SetControl(device, V4L2_CID_EXPOSURE_ABSOLUTE, tenths)
             ? Status()
             : NoExposure(name, "V4L2_CID_EXPOSURE_ABSOLUTE");
}

// A driver's text, which need not end within its field.
template <size_t size>
std::string Printable(const uint8_t (&text)[size]) {
  std::string printable(text, std::find(text, text + size, uint8_t{0}));
  std::replace_if(
      printable.begin(), printable.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return printable;
}

}  // namespace

Result<std::string> CameraName(const std::string& name, VideoDevice& device) {
  v4l2_capability capability = Zeroed<v4l2_capability>();
  if (Ask(device, VIDIOC_QUERYCAP, &capability) != 0) {
    return CannotOpen(name, "VIDIOC_QUERYCAP");
  }
  const uint32_t all = capability.capabilities;
  const uint32_t its = (all & V4L2_CAP_DEVICE_CAPS) != 0 ? capability.device_caps : all;
  constexpr uint32_t kNeeded = V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_STREAMING;
  if ((its & kNeeded) != kNeeded) {
    return Status::Error(name, "cannot be opened: it streams no video", "choose another number");
  }
  const std::string card = Printable(capability.card);
  return card.empty() ? name : card;
}

// Sizes and formats belong together: first the format with its size, then the rate.
Result<CameraMode> SetUpCamera(const std::string& name,
                               const CameraSettings& settings,
                               VideoDevice& device,
                               FrameConverter& converter) {
  CameraMode mode;
  LARARIUM_ASSIGN_OR_RETURN(mode.format, SetFormat(name, settings, device, converter));
  mode.frames_per_second = SetRate(settings, device);
  if (settings.exposure_ms) {
    LARARIUM_RETURN_IF_ERROR(SetExposure(name, *settings.exposure_ms, device));
  }
  return mode;
}

}  // namespace lararium::capture
