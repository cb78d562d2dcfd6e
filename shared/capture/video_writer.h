#pragma once

#include <filesystem>
#include <memory>
#include <opencv2/core/mat.hpp>

#include "shared/core/status.h"

namespace lararium::capture {

// Writes an H.264 MP4 (4:2:0, BT.709, limited range, index in front). The file
// appears under its name only when Finish() succeeds: until then it is written
// beside it, and removed if the writer goes away.
class VideoWriter {
 public:
  // width and height must be even.
  static Result<std::unique_ptr<VideoWriter>> Create(const std::filesystem::path& file,
                                                     int width,
                                                     int height,
                                                     double frames_per_second);
  ~VideoWriter();
  VideoWriter(const VideoWriter&) = delete;
  VideoWriter& operator=(const VideoWriter&) = delete;

  // bgr: CV_8UC3 of the writer's size, sRGB-encoded; shown for one frame interval.
  Status Write(const cv::Mat& bgr);
  // Completes the file and puts it in its place. Nothing may be written afterwards.
  Status Finish();

 private:
  struct Encoder;
  explicit VideoWriter(std::unique_ptr<Encoder> encoder);

  std::unique_ptr<Encoder> encoder_;
};

}  // namespace lararium::capture
