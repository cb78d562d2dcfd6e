#pragma once

#include <filesystem>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <span>

#include "shared/core/status.h"

namespace lararium::capture {

// Writes an H.264 MP4 (4:2:0, BT.709, limited range, index at the front), optionally with AAC
// sound. The file appears under its name only when Finish() succeeds: until then it is written
// beside it, and it is removed if the writer is destroyed.
class VideoWriter {
 public:
  static constexpr int kSoundRate = 48'000;  // Samples per second of each of the two channels.

  // width and height must be even. frames_per_second: the rate in the mean; frames may come at any
  // times.
  static Result<std::unique_ptr<VideoWriter>> Create(const std::filesystem::path& file,
                                                     int width,
                                                     int height,
                                                     double frames_per_second,
                                                     bool with_sound = false);
  ~VideoWriter();
  VideoWriter(const VideoWriter&) = delete;
  VideoWriter& operator=(const VideoWriter&) = delete;

  // bgr: CV_8UC3 of the writer's size, sRGB-encoded. It is shown from a time (seconds from the
  // beginning of the video) until the next frame. A time that is not later than that of the last
  // frame counts as one just after it.
  Status Write(const cv::Mat& bgr, double seconds);
  // Same as above, one frame interval after the last frame.
  Status Write(const cv::Mat& bgr);
  // Appends interleaved samples: left, right, ... The first sample is heard with frame 0. Requires
  // a writer with sound.
  Status WriteSound(std::span<const float> stereo);
  // Completes the file and moves it to its path. Nothing may be written afterwards.
  Status Finish();

 private:
  struct Encoder;
  explicit VideoWriter(std::unique_ptr<Encoder> encoder);

  std::unique_ptr<Encoder> encoder_;
};

}  // namespace lararium::capture
