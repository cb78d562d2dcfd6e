#include "shared/capture/camera_setup.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <optional>
#include <system_error>

namespace lararium::capture {
namespace {

// Defaults for settings that are not given.
constexpr int kUsualWidth = 640;
constexpr int kUsualHeight = 480;
constexpr double kUsualRate = 30.0;

constexpr char kChangeCapture[] = "change the device file's \"capture\"";

bool HasSize(const CameraSettings& settings) { return settings.width > 0 && settings.height > 0; }

std::string SizeText(int64_t width, int64_t height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

// Returns the format to request from the driver.
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
    return Status::Error(name, "offers no known image format", "use another camera");
  }
  return *chosen;
}

// Sets the format; the driver answers with the nearest one that it supports.
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
    return Status::Error(name, "does not offer the image format " + settings.format,
                         kChangeCapture);
  }
  if (HasSize(settings) && (given.width != static_cast<uint32_t>(settings.width) ||
                            given.height != static_cast<uint32_t>(settings.height))) {
    return Status::Error(name,
                         "does not offer images of " + SizeText(settings.width, settings.height) +
                             ", only of " + SizeText(given.width, given.height),
                         kChangeCapture);
  }
  if (given.width == 0 || given.height == 0) {
    errno = EINVAL;
    return CannotOpen(name, "VIDIOC_S_FMT");
  }
  return format;
}

// Sets the rate and returns the rate that the driver grants, which may differ from the requested
// one.
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
      name, std::string("does not allow setting its exposure (") + control + ": " + why + ")",
      "remove \"exposure_ms\" from the device file's \"capture\"");
}

Status SetExposure(const std::string& name, double milliseconds, VideoDevice& device) {
  // A camera without automatic exposure has no such control.
  if (!SetControl(device, V4L2_CID_EXPOSURE_AUTO, V4L2_EXPOSURE_MANUAL) && errno != EINVAL) {
    return NoExposure(name, "V4L2_CID_EXPOSURE_AUTO");
  }
  // The unit is a tenth of a millisecond.
  const int tenths = std::max(1, static_cast<int>(std::lround(10.0 * milliseconds)));
  return SetControl(device, V4L2_CID_EXPOSURE_ABSOLUTE, tenths)
             ? Status()
             : NoExposure(name, "V4L2_CID_EXPOSURE_ABSOLUTE");
}

// Converts a text of the driver, which need not be terminated within its field.
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

// Sizes depend on formats, so the format is set with its size first, and then the rate.
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
