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

  // Number of frames; nullopt for a live camera or where only reading tells.
  virtual std::optional<int64_t> frame_count() const = 0;
  virtual int width() const = 0;
  virtual int height() const = 0;
  virtual double frames_per_second() const = 0;
  virtual bool live() const = 0;

  // What to call frame index in reports and poses.json: "%06d.png" of videos
  // and cameras, the file name of image folders.
  virtual std::string FrameName(int64_t index) const = 0;
};

// Decodes with libav; Seek() is frame exact. Errors name the file.
Result<std::unique_ptr<FrameSource>> OpenVideo(const std::filesystem::path& file);

// All images (png, jpg, jpeg, bmp, tif, tiff) of a folder in order of their
// names; all must have one size.
Result<std::unique_ptr<FrameSource>> OpenImageFolder(const std::filesystem::path& folder);

// A live V4L2 camera.
Result<std::unique_ptr<FrameSource>> OpenCamera(int number);

// The focal length in pixels that the EXIF data of an image file give, by its
// 35 mm equivalent; nullopt where there is none.
std::optional<double> ExifFocalPixels(const std::filesystem::path& file, int width, int height);

}  // namespace lararium::capture
