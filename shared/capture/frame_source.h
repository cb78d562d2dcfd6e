#pragma once

// Where images come from: a camera, a video file, a folder of images.

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "shared/core/status.h"
#include "shared/geometry/camera_model.h"
#include "shared/geometry/frame.h"

namespace lararium::capture {

class FrameSource {
 public:
  virtual ~FrameSource() = default;

  // The next frame in order; nullopt at the end. Blocks for a live camera. A
  // frame that cannot be read is an error; the source may be asked again.
  virtual Result<std::optional<geometry::Frame>> Next() = 0;

  // Continues at frame index. Only for recorded sources; exact to the frame.
  virtual Status Seek(int64_t index) = 0;

  // Number of frames; nullopt for a live camera, and for a video until it was
  // read to its end: containers miscount.
  virtual std::optional<int64_t> frame_count() const = 0;
  // For progress bars and sliders, right within a few frames; 0 where unknown.
  virtual int64_t estimated_frame_count() const { return frame_count().value_or(0); }
  virtual int width() const = 0;
  virtual int height() const = 0;
  virtual double frames_per_second() const = 0;
  virtual bool live() const = 0;

  // What to call frame index in reports and poses.json: "%06d.png" of videos
  // and cameras, the file name of image folders.
  virtual std::string FrameName(int64_t index) const = 0;
};

// "%06d.png": the name of a frame that has none of its own.
std::string NumberedFrameName(int64_t index);

// Decodes with libav. Frames count in the order of decoding from the start;
// Seek() is exact, and quick within the part that was decoded before.
// Undecodable packets give no frame. A file that is cut off is an error.
Result<std::unique_ptr<FrameSource>> OpenVideo(const std::filesystem::path& file);

// All images (png, jpg, jpeg, bmp, tif, tiff) of a folder in order of their
// names, numbers within names by value (2 before 10). All must have one size.
// Pixels stay as stored: EXIF orientation is ignored. 30 frames per second.
Result<std::unique_ptr<FrameSource>> OpenImageFolder(const std::filesystem::path& folder);

// How a camera is to be run. What it refuses is refused with an error but for the rate: it takes
// the nearest, which frames_per_second() tells.
struct CameraSettings {
  std::string format = {};  // four letters: "MJPG", "YUYV"; empty: the best of this size
  int width = 0;            // pixels; 0: about 640x480
  int height = 0;
  double frames_per_second = 0.0;          // 0: 30
  std::optional<double> exposure_ms = {};  // none: as the camera has it
};

// A live V4L2 camera: /dev/video and the number. Next() gives the newest image, decoded by whoever
// calls; those before it and damaged ones are left out. Capture times are those of the driver.
Result<std::unique_ptr<FrameSource>> OpenCamera(int number, const CameraSettings& settings = {});

// The focal length in pixels that the EXIF data of an image file give, by its
// 35 mm equivalent (of equal diagonal); nullopt where there is none. Reads JPEG.
std::optional<double> ExifFocalPixels(const std::filesystem::path& file, int width, int height);

// How much light the EXIF data of an image file say it got: exposure time in seconds, over
// the square of the f-number and times ISO / 100 where those are known. nullopt where there is
// no exposure time. Reads JPEG.
std::optional<double> ExifExposure(const std::filesystem::path& file);

}  // namespace lararium::capture
