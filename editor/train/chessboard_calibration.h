#pragma once

// Calibrates a camera's intrinsics from views of a chessboard (Zhang, "A Flexible New Technique for
// Camera Calibration", PAMI 2000), estimates their errors, and advises what to film to reduce them.

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <functional>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "shared/capture/frame_source.h"
#include "shared/core/progress.h"
#include "shared/core/status.h"
#include "shared/geometry/camera_model.h"

namespace lararium::train {

// A chessboard, described by its inner corners, where four squares meet: a board of 10 x 7 squares
// has 9 x 6.
struct Board {
  static constexpr int kFewest = 3;  // Fewest and most inner corners along a side.
  static constexpr int kMost = 40;

  int columns = 9;      // Inner corners along a row.
  int rows = 6;         // Inner corners along a column.
  double square = 0.0;  // Side of a square, metres; 0 if unknown. Does not affect the intrinsics.

  Status Validate() const;
  std::string Text() const;  // "board 9x6"
  size_t corners() const { return static_cast<size_t>(columns) * static_cast<size_t>(rows); }
};

// Finds the inner corners in a grey image of 8 bits, in pixels, row by row. nullopt if the board is
// not completely visible.
std::optional<std::vector<Eigen::Vector2d>> FindBoard(const cv::Mat& grey, const Board& board);

// The result of adding an image.
enum class BoardObservation {
  kNone,     // No board was found.
  kBlurred,  // The view is less sharp than others.
  kAlike,    // A similar view exists already.
  kKept,
};

struct BoardView {
  std::string name;                      // Name of the image in the recording.
  int64_t frame = 0;                     // Index of the image in the recording.
  double blur_px = 0.0;                  // Width of the edges between squares.
  std::vector<Eigen::Vector2d> corners;  // Pixels, row by row.
};

// Counts how often corners were seen in each cell of the image.
struct CornerGrid {
  static constexpr int kColumns = 12;
  static constexpr int kRows = 9;
  std::array<std::array<int, kColumns>, kRows> counts = {};  // The first row is the top one.

  void Add(std::span<const Eigen::Vector2d> corners, int width, int height);
  double Covered() const;  // Share of the cells with corners.
};

// Minimum number of different views for a calibration.
inline constexpr size_t kFewestViews = 8;

// Number of image parts: three by three, row by row from the upper left.
inline constexpr int kImageParts = 9;

struct BoardCounts {
  int images = 0;   // Number of images searched.
  int found = 0;    // Number of images that show the board.
  int blurred = 0;  // Number of images that show the board blurred.
};

// Collects views that differ in position, size and tilt of the board. Of similar views the sharpest
// is kept. Deterministic.
class BoardCollector {
 public:
  static constexpr size_t kMostViews = 50;

  BoardCollector(const Board& board, int width, int height);

  BoardObservation Add(const geometry::Frame& frame, const std::string& name);
  // Adds a view that was found elsewhere.
  BoardObservation AddView(BoardView view);

  const Board& board() const { return board_; }
  int width() const { return width_; }
  int height() const { return height_; }
  // Corners in the image that was added last; empty if it shows no board.
  const std::vector<Eigen::Vector2d>& corners() const { return corners_; }
  const CornerGrid& grid() const { return grid_; }
  BoardCounts counts() const;
  size_t kept() const { return views_.size(); }
  // The sharp views, at most kMostViews, in the order of their images.
  std::vector<BoardView> Chosen() const;
  // The size of another board that was found. As long as board() has not been seen, boards with one
  // corner more or less along each side are searched for, too.
  std::optional<Board> OtherBoard() const { return other_; }

 private:
  // Position, size, tilt and roll of a board in the image, scaled for comparison.
  using Pose = Eigen::Matrix<double, 6, 1>;
  struct Entry {
    BoardView view;
    Pose pose;
  };

  Pose PoseOf(std::span<const Eigen::Vector2d> corners) const;
  double SharpLimit() const;
  void LookForOthers(const cv::Mat& grey);
  void MakeRoom();

  Board board_;
  int width_;
  int height_;
  std::vector<Eigen::Vector2d> corners_;
  CornerGrid grid_;
  std::vector<double> blurs_;  // BoardView::blur_px of all images with a board.
  std::vector<Entry> views_;
  int images_ = 0;
  std::optional<Board> other_;
};

// Advice for a better calibration.
struct CalibrationAdvice {
  enum class Kind {
    kTilt,      // value: relative standard deviation of the focal length
    kPart,      // value: index of an image part with hardly any corners; see kImageParts
    kBlur,      // value: number of views left out
    kFewViews,  // value: number of views
    kUneven,    // value: RMS in pixels; the board is bent, or the camera settings changed
    kHeldOut,   // value: RMS in pixels of the held-out views
    kAspect,    // value: fx / fy - 1
  };
  Kind kind = Kind::kTilt;
  double value = 0.0;
};

struct CalibratedView {
  enum class Part { kFitted, kHeldOut, kRejected };
  BoardView view;
  Part part = Part::kFitted;
  double rms_px = 0.0;    // Root mean square reprojection error of the corners.
  double tilt = 0.0;      // Angle between board and image plane, radians.
  double distance = 0.0;  // Distance of the board's centre; metres, or squares if unknown.
};

struct CameraDeviation {
  double fx = 0.0, fy = 0.0, cx = 0.0, cy = 0.0, k1 = 0.0, k2 = 0.0, p1 = 0.0, p2 = 0.0;
};

struct Calibration {
  enum class Verdict { kGood, kUsable, kPoor };

  geometry::CameraModel camera;
  // Standard deviations. Each is the larger of two estimates: from the residuals, assuming that
  // they are independent, and from leaving out every fifth part of the views in turn, which also
  // shows the effect of a bent board.
  CameraDeviation deviation;
  double rms_px = 0.0;           // RMS error of all corners of the fitted views.
  double held_out_rms_px = 0.0;  // RMS error of the held-out views; 0 if there are none.
  int fitted = 0;
  int held_out = 0;
  int rejected = 0;  // Number of views that contradict the others.
  BoardCounts counts;
  CornerGrid grid;                    // Corners of the fitted views.
  double covered = 0.0;               // Share of the grid's cells with corners.
  double max_tilt = 0.0;              // radians
  std::vector<CalibratedView> views;  // Ordered by image.
  Verdict verdict = Verdict::kGood;
  std::vector<CalibrationAdvice> advice;  // The most urgent first.

  double FocalDeviation() const { return deviation.fx / camera.fx; }
};

// Fails if no board was found, if most views are blurred, if too few views differ, or if all are
// from nearly one angle. Errors say what was seen and what to do.
Result<Calibration> Calibrate(const BoardCollector& views, Progress& progress);

// The state after an image, for callbacks. Holds references.
struct BoardMoment {
  const geometry::Frame& frame;
  BoardObservation observation;
  const BoardCollector& views;
};

// Searches for the board and then calibrates. In a recording it looks at about 240 images, evenly
// distributed; from a live camera it looks at all images for the given number of seconds. next is
// called after each image and ends the search by returning false. Cancelling gives an error.
Result<Calibration> CalibrateFromBoard(capture::FrameSource& source,
                                       const Board& board,
                                       double seconds,
                                       Progress& progress,
                                       const std::function<bool(const BoardMoment&)>& next = {});

}  // namespace lararium::train
