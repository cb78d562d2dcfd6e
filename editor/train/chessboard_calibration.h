#pragma once

// A camera's intrinsics from views of a chessboard: Zhang, "A Flexible New Technique for Camera
// Calibration", PAMI 2000; with the errors that they have, and what to film to make them less.

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

// Inner corners are those where four squares meet: a board of 10 x 7 squares has 9 x 6.
struct Board {
  static constexpr int kFewest = 3;  // corners of a side
  static constexpr int kMost = 40;

  int columns = 9;      // inner corners
  int rows = 6;         // likewise
  double square = 0.0;  // side in metres; 0: not known. Intrinsics do not depend on it

  Status Validate() const;
  std::string Text() const;  // "board 9x6"
  size_t corners() const { return static_cast<size_t>(columns) * static_cast<size_t>(rows); }
};

// The inner corners, row by row, pixels; nullopt where not all of the board is seen. grey: 8 bits.
std::optional<std::vector<Eigen::Vector2d>> FindBoard(const cv::Mat& grey, const Board& board);

// What came of an image.
enum class BoardSight {
  kNone,     // no board was found
  kBlurred,  // it is less sharp than others
  kAlike,    // a view like it is there already
  kKept,
};

struct BoardView {
  std::string name;                      // of the image, as the recording calls it
  int64_t frame = 0;                     // its index
  double blur_px = 0.0;                  // how far edges of squares reach
  std::vector<Eigen::Vector2d> corners;  // row by row, pixels
};

// How often corners were seen in cells of the image.
struct CornerGrid {
  static constexpr int kColumns = 12;
  static constexpr int kRows = 9;
  std::array<std::array<int, kColumns>, kRows> counts = {};  // from the top

  void Add(std::span<const Eigen::Vector2d> corners, int width, int height);
  double Covered() const;  // share of the cells
};

// Views that differ, without which there is no calibration.
inline constexpr size_t kFewestViews = 8;

// Parts of the image, three by three, row by row from the upper left.
inline constexpr int kImageParts = 9;

struct BoardCounts {
  int images = 0;   // that were looked at
  int found = 0;    // that show the board
  int blurred = 0;  // of these
};

// Gathers views that differ in where, how large and how tilted the board is; of those that are
// alike the sharpest. Deterministic.
class BoardCollector {
 public:
  static constexpr size_t kMostViews = 50;

  BoardCollector(const Board& board, int width, int height);

  BoardSight Add(const geometry::Frame& frame, const std::string& name);
  // A view that was found already.
  BoardSight AddView(BoardView view);

  const Board& board() const { return board_; }
  int width() const { return width_; }
  int height() const { return height_; }
  // Of the image that was added last; empty where it shows no board.
  const std::vector<Eigen::Vector2d>& corners() const { return corners_; }
  const CornerGrid& grid() const { return grid_; }
  BoardCounts counts() const;
  size_t kept() const { return views_.size(); }
  // The sharp ones, at most kMostViews, in the order of their images.
  std::vector<BoardView> Chosen() const;
  // Boards of a corner more or less on each side are looked for too where this one never was
  // seen: the size of one that was seen.
  std::optional<Board> OtherBoard() const { return other_; }

 private:
  // Where, how large and how tilted.
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
  std::vector<double> blurs_;  // of all images with a board
  std::vector<Entry> views_;
  int images_ = 0;
  std::optional<Board> other_;
};

// What to do for a better calibration.
struct CalibrationAdvice {
  enum class Kind {
    kTilt,      // value: standard deviation of the focal length, as a share of it
    kPart,      // value: which part of the image shows no corner; see kImageParts
    kBlur,      // value: how many views were left out
    kFewViews,  // value: how many there are
    kUneven,    // value: RMS in pixels; the board bends, or the camera changed meanwhile
    kHeldOut,   // value: RMS in pixels of the views that were held out
    kAspect,    // value: fx / fy - 1
  };
  Kind kind = Kind::kTilt;
  double value = 0.0;
};

struct CalibratedView {
  enum class Part { kFitted, kHeldOut, kRejected };
  BoardView view;
  Part part = Part::kFitted;
  double rms_px = 0.0;    // of its corners
  double tilt = 0.0;      // radians between board and image plane
  double distance = 0.0;  // of the board's middle; metres, or squares where those are not known
};

struct CameraDeviation {
  double fx = 0.0, fy = 0.0, cx = 0.0, cy = 0.0, k1 = 0.0, k2 = 0.0, p1 = 0.0, p2 = 0.0;
};

struct Calibration {
  enum class Verdict { kGood, kUsable, kPoor };

  geometry::CameraModel camera;
  // Standard deviations: the larger one of what the residuals give, were they independent, and of
  // what leaving out every fifth of the views in turn gives, which knows of bent boards too.
  CameraDeviation deviation;
  double rms_px = 0.0;           // of all corners of the views that were fitted
  double held_out_rms_px = 0.0;  // of every fifth view, which was not; 0 where there is none
  int fitted = 0;
  int held_out = 0;
  int rejected = 0;  // views that fit none of the others
  BoardCounts counts;
  CornerGrid grid;                    // of the fitted views
  double covered = 0.0;               // share of the image's cells
  double max_tilt = 0.0;              // radians
  std::vector<CalibratedView> views;  // in the order of their images
  Verdict verdict = Verdict::kGood;
  std::vector<CalibrationAdvice> advice;  // the most urgent first

  double FocalDeviation() const { return deviation.fx / camera.fx; }
};

// Errors say what was seen, and the remedy: no board, blurred ones only, too few that differ, all
// from one angle.
Result<Calibration> Calibrate(const BoardCollector& views, Progress& progress);

// What is known after an image; borrowed.
struct BoardMoment {
  const geometry::Frame& frame;
  BoardSight sight;
  const BoardCollector& views;
};

// Looks for the board in a recording (at some 240 images all over it; all of a folder) or, until
// seconds have gone, at what a live camera shows; then calibrates. next: told of each image;
// false: enough. Cancelled: an error.
Result<Calibration> CalibrateFromBoard(capture::FrameSource& source,
                                       const Board& board,
                                       double seconds,
                                       Progress& progress,
                                       const std::function<bool(const BoardMoment&)>& next = {});

}  // namespace lararium::train
