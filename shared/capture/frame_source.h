#pragma once

// Sources of images: a camera, a video file, a folder of images.

#include <filesystem>
#include <memory>
#include <opencv2/core/types.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "shared/core/status.h"
#include "shared/geometry/camera_model.h"
#include "shared/geometry/frame.h"

namespace lararium::capture {

// A camera that took frames of a source.
struct SourceCamera {
  cv::Size size;  // The size of its upright images before they are put into frames, pixels.
  cv::Rect area;  // The part of the frame that shows its image; the rest is black.
  // From EXIF data, in pixels of the frame.
  std::optional<double> focal_px = std::nullopt;
  // The images count as of one camera for their size only; no EXIF data name it.
  bool assumed = false;
  // The index of the camera whose lens took these images too, held in another way; not set: it is
  // the first with its lens.
  std::optional<size_t> lens_of = std::nullopt;
  // By how many right angles, clockwise, the images are turned from how the sensor sees.
  int quarter_turns = 0;
};

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

  // The cameras of the source, and the index of the one that took a frame.
  virtual std::vector<SourceCamera> Cameras() const {
    const cv::Size size(width(), height());
    return {{size, cv::Rect({0, 0}, size)}};
  }
  virtual size_t CameraOf(int64_t /*index*/) const { return 0; }

  // Name of frame `index` in reports and poses.json: "%06d.png" for videos and cameras, the file
  // name for image folders.
  virtual std::string FrameName(int64_t index) const = 0;

  // What a user should know of the source, each a sentence that names its file: what a film or a
  // folder contains that is not used, or is used in another way than it is stored.
  virtual std::vector<std::string> Notes() const { return {}; }
};

// Returns the name of a frame without a file name: "%06d.png".
std::string NumberedFrameName(int64_t index);

// Opens a video with libav. Frames are numbered in the order of decoding from the start. Seek() is
// exact, and fast within the part that was already decoded. Undecodable packets give no frame. A
// truncated file is an error. Frames are upright, of square pixels, not interlaced and in the
// colours of BT.709, also where the film is not; covers and previews in the file are not films.
Result<std::unique_ptr<FrameSource>> OpenVideo(const std::filesystem::path& file);

// The suffixes of images in a folder, with the dot, in lower case.
std::span<const char* const> ImageExtensions();

// Opens all images of a folder in the order of their names, in which numbers count by value (2
// before 10); if the folder holds none itself, those of all folders below it, with names relative
// to it. Hidden files are no images. Images that cannot be read are left out: Next() goes on with
// the image after them, and Notes() names them. EXIF orientation is honoured. 30 frames per second.
// Images of one size, and of one camera and focal length if EXIF data tell these, count as of one
// camera; those that it took upright, lying or upside down, as of one lens (SourceCamera::lens_of).
// If there are several sizes, each image lies in the middle of a frame that has room for
// all of them; images with more pixels than those of the most frequent size are reduced first.
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

// Returns the relative exposure from the EXIF data of an image file: exposure time in seconds,
// divided by the square of the f-number and multiplied by ISO / 100 where these are known. Returns
// nullopt if there is no exposure time.
std::optional<double> ExifExposure(const std::filesystem::path& file);

// Reads a photograph, upright as its EXIF data say: CV_8UC3. Errors: see image::DecodeImage.
Result<cv::Mat> ReadPhotograph(const std::filesystem::path& file);

}  // namespace lararium::capture
