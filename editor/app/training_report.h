#pragma once

// What a training came to, for people. It lies beside the map, so that it can be read again later.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "editor/app/place_recordings.h"
#include "editor/app/project.h"
#include "editor/train/capture_advice.h"
#include "editor/train/trainer.h"
#include "shared/core/json.h"
#include "shared/core/status.h"

namespace lararium::app {

struct TrainingReport {
  PlaceRecordings recordings;  // that the map is made of

  // Of the recording that was trained last; a path as the project has it. Empty: nothing but the
  // recordings is known.
  std::string recording;
  int frames = 0;
  int located = 0;                           // of these
  int64_t ended = 0;                         // seconds since 1970
  double seconds = 0.0;                      // that it took
  std::optional<double> focal_deviation_px;  // standard deviation; none: the focal length was given
  std::vector<train::CaptureAdvice> advice;  // what to film next, the most urgent first

  // Of the whole map.
  int keyframes = 0;
  int points = 0;
  double mean_error_px = 0.0;  // between sights and projections of points, raw pixels
  double error_95_px = 0.0;    // 95 % of the sights are not farther off
};

// recording: that result is of. metres_per_unit: of the map, where the stage has fixed it.
TrainingReport DescribeTraining(const PlaceRecordings& recordings,
                                const SourceDocument& recording,
                                const train::TrainResult& result,
                                std::optional<double> metres_per_unit);

// For terminals, English, several lines.
std::string TrainingText(const std::string& place, const TrainingReport& report);
// {"error_95_px", "total_seconds", "advice"}: what only a report has; advice in English sentences.
Json TrainingJson(const TrainingReport& report);

// Advice that earlier versions wrote, as sentences, or later ones, of kinds that are not known
// here, is said as it was written.
Result<TrainingReport> LoadTrainingReport(const std::filesystem::path& file);
Status SaveTrainingReport(const std::filesystem::path& file, const TrainingReport& report);

}  // namespace lararium::app
