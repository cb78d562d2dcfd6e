#pragma once

// A chessboard before a camera with ground truth, for tests of calibration.

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <span>
#include <string>
#include <vector>

#include "shared/capture/frame_source.h"
#include "shared/core/random.h"
#include "shared/geometry/camera_model.h"
#include "shared/geometry/transform.h"

namespace lararium::test {

// Inner corners (i, j) at (i, j, 0) times square, i below columns, j below rows; a white border
// one square wide is around the squares.
struct SyntheticBoard {
  int columns = 9;
  int rows = 6;
  double square = 0.025;  // metres
};

struct BoardPicture {
  geometry::Rigid3 camera_from_board;
  double blur_px = 0.7;   // standard deviation of the lens
  double smear_px = 0.0;  // length of motion blur along x
  double noise = 3.0;     // standard deviation, of 255
  bool board = true;      // otherwise what is behind it alone
};

// A pose in which all of the board is in the image, aimed at its pixel, with its plane turned by
// tilt radians out of the image's about an axis in it. distance: of the middle, metres.
geometry::Rigid3 AimedBoardPose(const SyntheticBoard& board,
                                const geometry::CameraModel& camera,
                                const Eigen::Vector2d& pixel,
                                double distance,
                                double tilt,
                                double tilt_axis,
                                double roll);

// All over the image, near and far, tilted up to 40 degrees, with all of the board in it.
std::vector<BoardPicture> VariedBoardPictures(const SyntheticBoard& board,
                                              const geometry::CameraModel& camera,
                                              int count,
                                              uint64_t seed);

// Whether all of it, with its border, is in the image.
bool BoardInside(const SyntheticBoard& board,
                 const geometry::CameraModel& camera,
                 const geometry::Rigid3& camera_from_board);

// The pictures as a recording.
class BoardRecording : public capture::FrameSource {
 public:
  BoardRecording(const SyntheticBoard& board,
                 const geometry::CameraModel& camera,
                 std::vector<BoardPicture> pictures);

  Result<std::optional<geometry::Frame>> Next() override;
  Status Seek(int64_t index) override;
  std::optional<int64_t> frame_count() const override {
    return static_cast<int64_t>(pictures_.size());
  }
  int width() const override { return camera_.width; }
  int height() const override { return camera_.height; }
  double frames_per_second() const override { return 30.0; }
  bool live() const override { return false; }
  std::string FrameName(int64_t index) const override { return std::to_string(index); }

  // Of a picture's number.
  cv::Mat Render(size_t index) const;

 private:
  SyntheticBoard board_;
  geometry::CameraModel camera_;
  std::vector<BoardPicture> pictures_;
  std::vector<cv::Vec2f> rays_;  // on the plane z = 1, kFine x kFine of each pixel
  size_t next_ = 0;
};

}  // namespace lararium::test
