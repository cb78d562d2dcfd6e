#pragma once

// Calibration of a camera with a chessboard (chessboard_calibration.h): from a recording or a live
// camera, for the command line and for the window.

#include <filesystem>
#include <memory>
#include <mutex>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

#include "editor/jobs/background_task.h"
#include "editor/text/command_result.h"
#include "editor/train/chessboard_calibration.h"
#include "shared/capture/frame_source.h"
#include "shared/core/json.h"
#include "shared/core/status.h"

namespace lararium::editor {

struct CalibrateOptions {
  // One of video, images and camera is set, unless a board is printed.
  std::filesystem::path video;
  std::filesystem::path images;
  std::string camera;  // A number, or a recording that is played at its own pace.
  int columns = 9;     // Inner corners of the board.
  int rows = 6;
  double square = 0.0;    // Side of a square of the board, metres; 0: not known.
  double seconds = 60.0;  // The duration of taking images from the camera.
  std::filesystem::path device_out;
  std::filesystem::path print_board;  // A file with the suffix .svg.
};

// fx, fy, cx, cy, k1, k2, p1, p2, in the format of `train --intrinsics` and of the dialogs.
std::string IntrinsicsText(const geometry::CameraModel& camera, const char* separator = ", ");

// translated: in the language of the interface; otherwise English.
std::string VerdictText(train::Calibration::Verdict verdict, bool translated);
// One sentence for each next step, the most urgent first.
std::vector<std::string> AdviceTexts(const train::Calibration& calibration, bool translated);

// The result as text for a terminal, and as JSON.
std::string CalibrationText(const train::Calibration& calibration);
Json CalibrationJson(const train::Calibration& calibration);

// Writes a field of the player's device file and keeps its other fields.
Status SaveDeviceField(const std::filesystem::path& file, const char* field, const Json& value);
// Writes the field `camera`.
Status SaveDeviceCamera(const std::filesystem::path& file, const geometry::CameraModel& camera);

// An A4 page with the board at its true size. Where the board has no size, its squares are the
// largest that fit, in whole millimetres. Fails where the board does not fit.
Result<std::string> BoardSvg(train::Board board);

// The state of a running calibration, for the window.
struct CalibrationMoment {
  std::shared_ptr<const cv::Mat> bgr;    // The image that was processed last.
  std::vector<Eigen::Vector2d> corners;  // The board's corners in that image, pixels.
  train::BoardObservation observation = train::BoardObservation::kNone;
  train::CornerGrid grid;
  train::BoardCounts counts;
  int kept = 0;  // The number of distinct views that are used.
};

// Calibrates on a separate thread.
class CalibrationTask {
 public:
  CalibrationTask(std::unique_ptr<capture::FrameSource> source, const train::Board& board);

  CalibrationMoment moment() const;
  BackgroundTask::State state() const { return task_.state(); }
  bool live() const { return live_; }
  // Takes no more images and computes the result.
  void Finish() { finish_ = true; }
  bool finishing() const { return finish_; }
  void Cancel() { task_.Cancel(); }
  // outcome() is set after the task has ended. result() is valid only after a successful outcome.
  std::optional<Status> outcome() const { return task_.outcome(); }
  const train::Calibration& result() const { return result_; }

 private:
  Status Run(capture::FrameSource& source, const train::Board& board, Progress& progress);

  bool live_;
  std::atomic<bool> finish_ = false;
  mutable std::mutex mutex_;
  CalibrationMoment moment_;
  train::Calibration result_;  // Written before the outcome.
  // The last member, so that the thread is joined before the others are destroyed.
  BackgroundTask task_;
};

Result<CommandResult> RunCalibrate(const CalibrateOptions& options, Progress& progress);

}  // namespace lararium::editor
