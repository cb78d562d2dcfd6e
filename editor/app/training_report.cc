#include "editor/app/training_report.h"

#include <chrono>
#include <limits>
#include <utility>

#include "editor/app/background_task.h"
#include "editor/app/document_fields.h"
#include "editor/app/text.h"
#include "editor/train/capture_analysis.h"
#include "editor/train/map_statistics.h"

namespace lararium::app {

namespace {

constexpr int kSchema = 1;
constexpr int kMostCounted = 1'000'000'000;
constexpr size_t kMostAdvice = 1000;

Status ParseTraining(const JsonView& view, TrainingReport& report) {
  LARARIUM_ASSIGN_OR_RETURN(report.recording, view.Text("recording"));
  for (const auto& [key, count] : {std::pair{"frames", &report.frames},
                                   {"located", &report.located},
                                   {"keyframes", &report.keyframes},
                                   {"points", &report.points}}) {
    LARARIUM_ASSIGN_OR_RETURN(const int64_t value, view.Integer(key, 0, kMostCounted));
    *count = static_cast<int>(value);
  }
  for (const auto& [key, number] : {std::pair{"seconds", &report.seconds},
                                    {"mean_error_px", &report.mean_error_px},
                                    {"error_95_px", &report.error_95_px}}) {
    LARARIUM_ASSIGN_OR_RETURN(*number, view.Number(key, 0.0));
  }
  LARARIUM_ASSIGN_OR_RETURN(report.ended,
                            view.Integer("ended", 0, std::numeric_limits<int64_t>::max()));
  if (view.Has("focal_deviation_px")) {
    LARARIUM_ASSIGN_OR_RETURN(report.focal_deviation_px, view.Number("focal_deviation_px", 0.0));
  }
  LARARIUM_ASSIGN_OR_RETURN(const JsonView advice, view.Field("advice"));
  LARARIUM_ASSIGN_OR_RETURN(const std::vector<JsonView> list, advice.Array(kMostAdvice));
  for (const JsonView& entry : list) {
    LARARIUM_ASSIGN_OR_RETURN(report.advice.emplace_back(), entry.Text());
  }
  return Status();
}

Json FormatTraining(const TrainingReport& report) {
  Json json = {{"recording", report.recording},     {"frames", report.frames},
               {"located", report.located},         {"keyframes", report.keyframes},
               {"points", report.points},           {"ended", report.ended},
               {"seconds", report.seconds},         {"mean_error_px", report.mean_error_px},
               {"error_95_px", report.error_95_px}, {"advice", report.advice}};
  if (report.focal_deviation_px) {
    json["focal_deviation_px"] = *report.focal_deviation_px;
  }
  return json;
}

}  // namespace

TrainingReport DescribeTraining(const PlaceRecordings& recordings,
                                const SourceDocument& recording,
                                const train::TrainResult& result,
                                std::optional<double> metres_per_unit) {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  TrainingReport report;
  report.recordings = recordings;
  report.recording = recording.path;
  report.frames = result.report.frames;
  report.located = static_cast<int>(result.report.located.size());
  report.ended = std::chrono::duration_cast<std::chrono::seconds>(now).count();
  for (const auto& [step, seconds] : result.report.seconds) {
    report.seconds += seconds;
  }
  if (result.report.intrinsics_estimated) {
    report.focal_deviation_px = result.report.focal_deviation_px;
  }
  report.advice = train::AnalyseCapture(result.report, result.database, metres_per_unit).advice;
  report.keyframes = static_cast<int>(result.database.keyframes.size());
  report.points = static_cast<int>(result.database.points.size());
  report.mean_error_px = result.database.mean_reprojection_error_px;
  report.error_95_px = train::ErrorQuantilePx(result.database, 0.95);
  return report;
}

std::string TrainingText(const std::string& place, const TrainingReport& report) {
  std::string text =
      Text("%s: %d of %d images located, %d points, mean reprojection error %.3f px\n",
           place.c_str(), report.located, report.frames, report.points, report.mean_error_px);
  text += Text("95 %% of the sights are within %.3f px; the training took %s\n", report.error_95_px,
               FormatDuration(report.seconds).c_str());
  text += "what to film next:\n";
  for (const std::string& advice : report.advice) {
    text += "- " + advice + "\n";
  }
  return text;
}

Json TrainingJson(const TrainingReport& report) {
  return {{"error_95_px", report.error_95_px},
          {"total_seconds", report.seconds},
          {"advice", report.advice}};
}

Result<TrainingReport> LoadTrainingReport(const std::filesystem::path& file) {
  LARARIUM_ASSIGN_OR_RETURN(const Json json, LoadJson(file));
  const JsonView view(json, file.string());
  LARARIUM_RETURN_IF_ERROR(CheckFields(view, {"schema", "recordings", "training"}));
  LARARIUM_RETURN_IF_ERROR(view.Integer("schema", kSchema, kSchema).status());
  TrainingReport report;
  LARARIUM_ASSIGN_OR_RETURN(const JsonView recordings, view.Field("recordings"));
  LARARIUM_ASSIGN_OR_RETURN(report.recordings, ParseRecordings(recordings));
  if (view.Has("training")) {
    LARARIUM_ASSIGN_OR_RETURN(const JsonView training, view.Field("training"));
    LARARIUM_RETURN_IF_ERROR(ParseTraining(training, report));
  }
  return report;
}

Status SaveTrainingReport(const std::filesystem::path& file, const TrainingReport& report) {
  Json json = {{"schema", kSchema}, {"recordings", FormatRecordings(report.recordings)}};
  if (!report.recording.empty()) {
    json["training"] = FormatTraining(report);
  }
  return SaveJson(file, json);
}

}  // namespace lararium::app
