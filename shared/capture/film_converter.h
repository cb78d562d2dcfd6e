#pragma once

// Converts the decoded pictures of a film to the images that the rest of the program expects:
// upright, of square pixels, not interlaced, in the colours of BT.709. What a film says of itself
// decides which of these steps are done; an ordinary film is only converted from YCbCr to BGR.
//
// libavfilter could do the same, but loads about forty further libraries (speech recognition and
// Vulkan among them) at every start of the player, which plays recorded films too. Private to
// capture.

#include <filesystem>
#include <opencv2/core/types.hpp>
#include <optional>
#include <string>
#include <vector>

#include "shared/capture/sdr_table.h"
#include "shared/core/status.h"
#include "shared/geometry/frame.h"
#include "shared/geometry/frame_pool.h"
#include "shared/image/libav.h"
#include "shared/image/pixel_orientation.h"

namespace lararium::capture {

class FilmConverter {
 public:
  // first: the first decoded picture. Fails for films whose pictures cannot be understood without
  // further data (Dolby Vision, profiles 5 and 10.0).
  static Result<FilmConverter> Create(const std::filesystem::path& file,
                                      AVFormatContext& format,
                                      AVStream& stream,
                                      const AVFrame& first);

  // The size of the images.
  cv::Size size() const { return size_; }
  // What a user should know of the film.
  const std::vector<std::string>& notes() const { return notes_; }
  bool high_dynamic_range() const { return colours_.high_dynamic_range(); }

  // Measures a picture of a film with a high dynamic range. Its highlights decide how bright the
  // images become (SdrTable), so they are measured before the first call of Convert().
  Status MeasureHighlights(const AVFrame& picture);

  // Fills the pixels of a frame. Allocates nothing once images of the pool are free.
  Status Convert(const AVFrame& picture, geometry::Frame& frame);

 private:
  explicit FilmConverter(std::filesystem::path file) : file_(std::move(file)) {}

  void Note(const std::string& text);
  void NoteColours(const AVFrame& first);
  void NoteViews(const AVStream& stream);
  image::PixelOrientation OrientationOf(const AVFrame& picture) const;
  // Returns the picture, which has the size stored_, with rows and columns as they are stored.
  Result<cv::Mat> ToBgr(const AVFrame& picture, int type);
  Status PrepareScaler(const AVFrame& picture, int rows, int type);
  Status Problem(const std::string& problem, const std::string& remedy) const;

  std::filesystem::path file_;
  cv::Size stored_;  // The size of the decoded pictures.
  cv::Size square_;  // The size of the pictures with square pixels.
  cv::Size size_;
  image::PixelOrientation orientation_;  // This holds for pictures that do not state their own.
  // The orientation of the first picture.
  image::PixelOrientation first_orientation_;
  bool turns_ = false;  // True if it was told that orientations differ.
  FilmColours colours_;
  double highlights_ = 0.0;
  std::optional<SdrTable> table_;
  image::LibavPtr<SwsContext> scaler_;
  geometry::FramePool pool_;
  std::vector<std::string> notes_;
};

}  // namespace lararium::capture
