#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <span>

#include "shared/core/status.h"

namespace lararium::capture {

// Writes an H.264 MP4 (4:2:0, BT.709, limited range, index in front), with AAC sound if it
// is to have some. The file
// appears under its name only when Finish() succeeds: until then it is written
// beside it, and removed if the writer goes away.
class VideoWriter {
 public:
  static constexpr int kSoundRate = 48'000;  // samples a second, of two channels

  // width and height must be even.
  static Result<std::unique_ptr<VideoWriter>> Create(const std::filesystem::path& file,
                                                     int width,
                                                     int height,
                                                     double frames_per_second,
                                                     bool with_sound = false);
  ~VideoWriter();
  VideoWriter(const VideoWriter&) = delete;
  VideoWriter& operator=(const VideoWriter&) = delete;

  // bgr: CV_8UC3 of the writer's size, sRGB-encoded; shown from the moment of frame index
  // of the video on, until the next one. Indices increase.
  Status Write(const cv::Mat& bgr, int64_t index);
  // The same, for one frame interval after the last one.
  Status Write(const cv::Mat& bgr);
  // The next samples: left, right, ... The first of all is heard with frame 0. Of a
  // writer with sound.
  Status WriteSound(std::span<const float> stereo);
  // Completes the file and puts it in its place. Nothing may be written afterwards.
  Status Finish();

 private:
  struct Encoder;
  explicit VideoWriter(std::unique_ptr<Encoder> encoder);

  std::unique_ptr<Encoder> encoder_;
};

}  // namespace lararium::capture
