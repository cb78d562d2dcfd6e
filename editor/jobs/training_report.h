#pragma once

// The result of a training in a form for people. It is stored beside the map, so that it can be
// read later.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "editor/document/place_recordings.h"
#include "editor/document/project.h"
#include "editor/train/capture_advice.h"
#include "editor/train/trainer.h"
#include "shared/core/json.h"
#include "shared/core/status.h"

namespace lararium::editor {

struct TrainingReport {
  PlaceRecordings recordings;  // The recordings that the map is made of.
  // What people should know of these recordings (capture::FrameSource::Notes), or of the model that
  // the map was imported from.
  std::vector<std::string> warnings;

  // The recording that was trained last, as a path of the project. Empty: only the recordings are
  // known.
  std::string recording;
  int frames = 0;
  int located = 0;       // How many of frames were located.
  int64_t ended = 0;     // Seconds since 1970.
  double seconds = 0.0;  // The duration of the training.
  // Standard deviation of the focal length; not set: it was given.
  std::optional<double> focal_deviation_px;
  std::vector<train::CaptureAdvice> advice;  // Sorted: the most urgent advice first.

  // The following fields are about the whole map.
  int keyframes = 0;
  int points = 0;
  double mean_error_px = 0.0;  // Mean reprojection error, raw pixels.
  double error_95_px = 0.0;    // 95th percentile of the reprojection errors, raw pixels.
};

// recording: the recording that result is about. metres_per_unit: the scale of the map, if the
// stage defines it.
TrainingReport DescribeTraining(const PlaceRecordings& recordings,
                                const SourceDocument& recording,
                                const train::TrainResult& result,
                                std::optional<double> metres_per_unit);

// Several lines in English, for terminals.
std::string TrainingText(const std::string& place, const TrainingReport& report);
// {"error_95_px", "total_seconds", "advice"}: the fields that ReportJson() does not have. Advice is
// in English sentences.
Json TrainingJson(const TrainingReport& report);

// Keeps advice of an unknown kind as the sentence that was written.
Result<TrainingReport> LoadTrainingReport(const std::filesystem::path& file);
Status SaveTrainingReport(const std::filesystem::path& file, const TrainingReport& report);

}  // namespace lararium::editor
