#pragma once

// Calibrating a camera with a chessboard (chessboard_calibration.h): from a recording or a live
// camera, on the command line or beside the window.

#include <filesystem>
#include <memory>
#include <mutex>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

#include "editor/app/background_task.h"
#include "editor/app/options.h"
#include "editor/app/subcommands.h"
#include "editor/train/chessboard_calibration.h"
#include "shared/capture/frame_source.h"
#include "shared/core/json.h"
#include "shared/core/status.h"

namespace lararium::app {

// fx, fy, cx, cy, k1, k2, p1, p2, as `train --intrinsics` and dialogs take them.
std::string IntrinsicsText(const geometry::CameraModel& camera, const char* separator = ", ");

// In the language of the interface, or untranslated.
std::string VerdictText(train::Calibration::Verdict verdict, bool translated);
// What to do next, the most urgent first; a sentence each.
std::vector<std::string> AdviceTexts(const train::Calibration& calibration, bool translated);

// Lines for people, and the same for programs.
std::string CalibrationText(const train::Calibration& calibration);
Json CalibrationJson(const train::Calibration& calibration);

// Writes a field of the player's device file; what else is in one that is there stays.
Status SaveDeviceField(const std::filesystem::path& file, const char* field, const Json& value);
// The field `camera`.
Status SaveDeviceCamera(const std::filesystem::path& file, const geometry::CameraModel& camera);

// A sheet of A4 with the board at its true size. Squares as large as they fit, in whole
// millimetres, where the board does not say; an error where it does not fit.
Result<std::string> BoardSvg(train::Board board);

// What the window shows of a calibration that is under way.
struct CalibrationMoment {
  std::shared_ptr<const cv::Mat> bgr;    // the image that was looked at last
  std::vector<Eigen::Vector2d> corners;  // of the board in it
  train::BoardSight sight = train::BoardSight::kNone;
  train::CornerGrid grid;
  train::BoardCounts counts;
  int kept = 0;  // views that differ
};

// On a thread of its own.
class CalibrationTask {
 public:
  CalibrationTask(std::unique_ptr<capture::FrameSource> source, const train::Board& board);

  CalibrationMoment moment() const;
  BackgroundTask::State state() const { return task_.state(); }
  bool live() const { return live_; }
  // Looks no further, and calibrates.
  void Finish() { finish_ = true; }
  bool finishing() const { return finish_; }
  void Cancel() { task_.Cancel(); }
  // Once it has ended. The result only after an outcome that is ok.
  std::optional<Status> outcome() const { return task_.outcome(); }
  const train::Calibration& result() const { return result_; }

 private:
  Status Run(capture::FrameSource& source, const train::Board& board, Progress& progress);

  bool live_;
  std::atomic<bool> finish_ = false;
  mutable std::mutex mutex_;
  CalibrationMoment moment_;
  train::Calibration result_;  // written before the outcome
  BackgroundTask task_;        // last: joined before the rest goes
};

Result<CommandResult> RunCalibrate(const CalibrateOptions& options, Progress& progress);

}  // namespace lararium::app
