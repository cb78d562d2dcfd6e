#pragma once

// Sources of images: a camera, a video file, a folder of images.

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "shared/core/status.h"
#include "shared/geometry/camera_model.h"
#include "shared/geometry/frame.h"

namespace lararium::capture {

class FrameSource {
 public:
  virtual ~FrameSource() = default;

  // Returns the next frame in order; nullopt at the end. Blocks for a live camera. A frame that
  // cannot be read is an error; Next() may be called again.
  virtual Result<std::optional<geometry::Frame>> Next() = 0;

  // Continues at frame `index`, exact to the frame. Only for recorded sources.
  virtual Status Seek(int64_t index) = 0;

  // Number of frames; nullopt for a live camera, and for a video until it was read to its end,
  // because containers may state a wrong number.
  virtual std::optional<int64_t> frame_count() const = 0;
  // Estimate within a few frames, for progress bars and sliders; 0 if unknown.
  virtual int64_t estimated_frame_count() const { return frame_count().value_or(0); }
  virtual int width() const = 0;
  virtual int height() const = 0;
  virtual double frames_per_second() const = 0;
  virtual bool live() const = 0;

  // Name of frame `index` in reports and poses.json: "%06d.png" for videos and cameras, the file
  // name for image folders.
  virtual std::string FrameName(int64_t index) const = 0;
};

// Returns the name of a frame without a file name: "%06d.png".
std::string NumberedFrameName(int64_t index);

// Opens a video with libav. Frames are numbered in the order of decoding from the start. Seek() is
// exact, and fast within the part that was already decoded. Undecodable packets give no frame. A
// truncated file is an error.
Result<std::unique_ptr<FrameSource>> OpenVideo(const std::filesystem::path& file);

// The suffixes of images in a folder, with the dot, in lower case.
std::span<const char* const> ImageExtensions();

// Opens all images of a folder in the order of their names, in which numbers count by value (2
// before 10). All must have the same size. Pixels stay as stored: EXIF orientation is ignored. 30
// frames per second.
Result<std::unique_ptr<FrameSource>> OpenImageFolder(const std::filesystem::path& folder);

// Requested settings of a camera. Settings that the camera refuses are errors, except the rate: the
// nearest one is used, and frames_per_second() returns it.
struct CameraSettings {
  std::string format = {};  // Four letters: "MJPG", "YUYV"; empty: the best format for the size.
  int width = 0;            // pixels; 0: about 640x480
  int height = 0;
  double frames_per_second = 0.0;          // 0: 30
  std::optional<double> exposure_ms = {};  // Not set: the camera's own setting.
};

// Opens a live V4L2 camera, /dev/video and the number. Next() returns the newest image, which is
// decoded in the calling thread; older and damaged images are skipped. Capture times are those of
// the driver.
Result<std::unique_ptr<FrameSource>> OpenCamera(int number, const CameraSettings& settings = {});

// Returns the focal length in pixels from the EXIF data of an image file, by its 35 mm equivalent
// (of equal diagonal); nullopt if there is none. Reads JPEG.
std::optional<double> ExifFocalPixels(const std::filesystem::path& file, int width, int height);

// Returns the relative exposure from the EXIF data of an image file: exposure time in seconds,
// divided by the square of the f-number and multiplied by ISO / 100 where these are known. Returns
// nullopt if there is no exposure time. Reads JPEG.
std::optional<double> ExifExposure(const std::filesystem::path& file);

}  // namespace lararium::capture
