#pragma once

// Makes BGR images of what cameras send: raw colours, Motion JPEG, sensors' mosaics and formats
// of single makers. Private to capture.

#include <linux/videodev2.h>

#include <cstdint>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <span>
#include <string>

#include "shared/capture/video_device.h"
#include "shared/core/status.h"

struct v4lconvert_data;  // NOLINT(readability-identifier-naming): libv4lconvert's

namespace lararium::capture {

class FrameConverter {
 public:
  // device must outlive it.
  static Result<FrameConverter> Create(const std::string& name, VideoDevice& device);

  // The camera's format that gives images of this size, or of the nearest, at the least cost and
  // as often as that; nullopt where none is known.
  std::optional<v4l2_format> Choose(int width, int height, double frames_per_second);

  // Fills bgr, CV_8UC3 of the format's size and without gaps between its rows. sent may be
  // changed. Not where the image is damaged: then Problem() has the reason.
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
  bool marks_ends_ = false;  // of JPEG images: known once one was seen
  std::string problem_;
};

}  // namespace lararium::capture
