#pragma once

// Converts the formats of cameras to BGR images: raw colours, Motion JPEG, sensor mosaics and
// formats of single manufacturers. Private to capture.

#include <linux/videodev2.h>

#include <cstdint>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <span>
#include <string>

#include "shared/capture/video_device.h"
#include "shared/core/status.h"

struct v4lconvert_data;  // NOLINT(readability-identifier-naming): libv4lconvert's name

namespace lararium::capture {

class FrameConverter {
 public:
  // device must outlive the converter.
  static Result<FrameConverter> Create(const std::string& name, VideoDevice& device);

  // Returns the camera's format that gives images of this size (or the nearest size) at this rate
  // with the least processing; nullopt if none is known.
  std::optional<v4l2_format> Choose(int width, int height, double frames_per_second);

  // Fills bgr, which is CV_8UC3 with the format's size and without gaps between rows. May change
  // `sent`. Returns false if the image is damaged; Problem() then has the reason.
  bool Convert(const v4l2_format& format, std::span<uint8_t> sent, cv::Mat& bgr);
  const std::string& Problem() const { return problem_; }

 private:
  struct Destroy {
    void operator()(v4lconvert_data* data) const;
  };

  explicit FrameConverter(v4lconvert_data* data) : data_(data) {}
  bool Refuse(std::string problem);
  bool IsWhole(std::span<const uint8_t> jpeg);

  std::unique_ptr<v4lconvert_data, Destroy> data_;
  bool marks_ends_ = false;  // True after a JPEG image with an end marker.
  std::string problem_;
};

}  // namespace lararium::capture
