#include "shared/capture/frame_converter.h"

// The order matters: the second header uses types from headers that the first includes.
#include <libv4lconvert.h>
//
#include <libv4l-plugin.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace lararium::capture {
namespace {

// Passes ioctl() calls of libv4lconvert to the driver.
int AskFor(void* device, int /*descriptor*/, unsigned long request, void* argument) {
  return Ask(*static_cast<VideoDevice*>(device), request, argument);
}

constexpr libv4l_dev_ops kCalls = {.init = nullptr,
                                   .close = nullptr,
                                   .ioctl = AskFor,
                                   .read = nullptr,
                                   .write = nullptr,
                                   .reserved1 = nullptr,
                                   .reserved2 = nullptr,
                                   .reserved3 = nullptr,
                                   .reserved4 = nullptr,
                                   .reserved5 = nullptr,
                                   .reserved6 = nullptr,
                                   .reserved7 = nullptr};

// Formats of luma and subsampled chroma. libv4lconvert leaves their luma at 16 to 235, so that
// black becomes grey, and takes three times as long.
struct HalvedChroma {
  uint32_t format;
  int code;         // code for cv::cvtColor
  bool two_planes;  // Chroma follows luma in a second plane and is halved in height too.
};
constexpr HalvedChroma kHalvedChroma[] = {
    {V4L2_PIX_FMT_YUYV, cv::COLOR_YUV2BGR_YUY2, false},
    {V4L2_PIX_FMT_YVYU, cv::COLOR_YUV2BGR_YVYU, false},
    {V4L2_PIX_FMT_UYVY, cv::COLOR_YUV2BGR_UYVY, false},
    {V4L2_PIX_FMT_NV12, cv::COLOR_YUV2BGR_NV12, true},
    {V4L2_PIX_FMT_NV21, cv::COLOR_YUV2BGR_NV21, true},
};

// Returns nullptr for formats that libv4lconvert converts. cv::cvtColor accepts even sizes only.
const HalvedChroma* FindHalvedChroma(const v4l2_pix_format& format) {
  const auto* found =
      std::find_if(std::begin(kHalvedChroma), std::end(kHalvedChroma),
                   [&](const HalvedChroma& h) { return h.format == format.pixelformat; });
  const bool even = format.width % 2 == 0 && format.height % 2 == 0;
  return found != std::end(kHalvedChroma) && even ? found : nullptr;
}

// Returns false if bytes are missing.
bool ConvertHalvedChroma(const HalvedChroma& halved,
                         const v4l2_pix_format& format,
                         std::span<uint8_t> sent,
                         cv::Mat& bgr) {
  const int width = static_cast<int>(format.width);
  const int height = static_cast<int>(format.height);
  const size_t used = static_cast<size_t>(width) * (halved.two_planes ? 1 : 2);
  const size_t step = std::max<size_t>(format.bytesperline, used);
  const size_t rows = static_cast<size_t>(height) * (halved.two_planes ? 3 : 2) / 2;
  if (sent.size() < step * (rows - 1) + used) {
    return false;
  }
  if (halved.two_planes) {
    const cv::Mat luma(height, width, CV_8UC1, sent.data(), step);
    const cv::Mat chroma(height / 2, width / 2, CV_8UC2, sent.data() + step * format.height, step);
    cv::cvtColorTwoPlane(luma, chroma, bgr, halved.code);
  } else {
    cv::cvtColor(cv::Mat(height, width, CV_8UC2, sent.data(), step), bgr, halved.code);
  }
  return true;
}

bool IsJpeg(uint32_t format) { return format == V4L2_PIX_FMT_MJPEG || format == V4L2_PIX_FMT_JPEG; }

}  // namespace

void FrameConverter::Destroy::operator()(v4lconvert_data* data) const { v4lconvert_destroy(data); }

Result<FrameConverter> FrameConverter::Create(const std::string& name, VideoDevice& device) {
  v4lconvert_data* data = v4lconvert_create_with_dev_ops(device.descriptor(), &device, &kCalls);
  if (data == nullptr) {
    return CannotOpen(name, "libv4lconvert");
  }
  return FrameConverter(data);
}

std::optional<v4l2_format> FrameConverter::Choose(int width, int height, double frames_per_second) {
  v4lconvert_set_fps(data_.get(), static_cast<int>(std::lround(frames_per_second)));
  v4l2_format wanted = Zeroed<v4l2_format>();
  wanted.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  wanted.fmt.pix.width = static_cast<uint32_t>(width);
  wanted.fmt.pix.height = static_cast<uint32_t>(height);
  wanted.fmt.pix.pixelformat = V4L2_PIX_FMT_BGR24;
  v4l2_format chosen = Zeroed<v4l2_format>();
  const bool found = v4lconvert_try_format(data_.get(), &wanted, &chosen) == 0 &&
                     wanted.fmt.pix.pixelformat == V4L2_PIX_FMT_BGR24;
  return found ? std::optional(chosen) : std::nullopt;
}

bool FrameConverter::Convert(const v4l2_format& format, std::span<uint8_t> sent, cv::Mat& bgr) {
  if (IsJpeg(format.fmt.pix.pixelformat) && !IsWhole(sent)) {
    return Refuse("cut short");
  }
  if (const HalvedChroma* halved = FindHalvedChroma(format.fmt.pix)) {
    return ConvertHalvedChroma(*halved, format.fmt.pix, sent, bgr) || Refuse("cut short");
  }
  // The image keeps the camera's size even if libv4lconvert would crop it, because cropping changes
  // the rays of pixels.
  v4l2_format wanted = format;
  wanted.fmt.pix.pixelformat = V4L2_PIX_FMT_BGR24;
  v4lconvert_fixup_fmt(&wanted);
  const int size = static_cast<int>(bgr.total() * bgr.elemSize());
  const int written = v4lconvert_convert(data_.get(), &format, &wanted, sent.data(),
                                         static_cast<int>(sent.size()), bgr.data, size);
  return written == size || Refuse(v4lconvert_get_error_message(data_.get()));
}

bool FrameConverter::Refuse(std::string problem) {
  problem_ = std::move(problem);
  problem_.erase(problem_.find_last_not_of(" \n") + 1);
  return false;
}

// Truncated images lack JPEG's end marker, which libjpeg would add. Some cameras never send it.
bool FrameConverter::IsWhole(std::span<const uint8_t> jpeg) {
  for (size_t i = jpeg.size(); i >= 2; --i) {
    if (jpeg[i - 2] == 0xff && jpeg[i - 1] == 0xd9) {
      marks_ends_ = true;
      return true;
    }
  }
  return !marks_ends_;
}

}  // namespace lararium::capture
