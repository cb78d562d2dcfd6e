#pragma once

// Pictures of a chessboard with ground truth, for tests of calibration.

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

// Inner corners (i, j) are at (i, j, 0) times square, i below columns, j below rows. A white border
// one square wide surrounds the squares.
struct SyntheticBoard {
  int columns = 9;
  int rows = 6;
  double square = 0.025;  // metres
};

struct BoardPicture {
  geometry::Rigid3 camera_from_board;
  double blur_px = 0.7;   // Standard deviation of the lens blur, pixels.
  double smear_px = 0.0;  // Length of motion blur along x, pixels.
  double noise = 3.0;     // Standard deviation; full scale is 255.
  bool board = true;      // False: only the background.
};

// A pose with the whole board in the image and its middle at `pixel`. The board's plane is turned
// by tilt radians out of the image plane, about an axis in it. distance: of the middle, metres.
geometry::Rigid3 AimedBoardPose(const SyntheticBoard& board,
                                const geometry::CameraModel& camera,
                                const Eigen::Vector2d& pixel,
                                double distance,
                                double tilt,
                                double tilt_axis,
                                double roll);

// Pictures with the whole board at positions all over the image, near and far, tilted up to 40
// degrees.
std::vector<BoardPicture> VariedBoardPictures(const SyntheticBoard& board,
                                              const geometry::CameraModel& camera,
                                              int count,
                                              uint64_t seed);

// Whether the whole board, with its border, is in the image.
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

  // Renders a picture by its index.
  cv::Mat Render(size_t index) const;

 private:
  SyntheticBoard board_;
  geometry::CameraModel camera_;
  std::vector<BoardPicture> pictures_;
  std::vector<cv::Vec2f> rays_;  // kFine x kFine rays per pixel on the plane z = 1.
  size_t next_ = 0;
};

}  // namespace lararium::test
