#include "editor/jobs/training_report.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <utility>

#include "editor/jobs/background_task.h"
#include "editor/text/text.h"
#include "editor/train/capture_analysis.h"
#include "editor/train/map_statistics.h"

namespace lararium::editor {

namespace {

constexpr int kSchema = 2;
constexpr int kMostCounted = 1'000'000'000;
constexpr size_t kMostAdvice = 1000;
constexpr size_t kMostWarnings = 10'000;

// ------------------------------------------------------------ Advice

using train::CaptureAdvice;

// Indexed by CaptureAdvice::Kind; kWritten has no name.
constexpr std::array<std::string_view, 15> kKinds = {
    "enough",     "not_located",   "short_gaps", "one_side",   "step_left",
    "step_right", "step_nearer",   "step_back",  "turn_left",  "turn_right",
    "focal",      "few_keyframes", "exposure",   "lookalikes", "unordered"};
// Indexed by CaptureAdvice::End; kNone is not written.
constexpr std::array<std::string_view, 5> kPathEnds = {"", "left", "right", "near", "far"};
constexpr std::array<std::string_view, 5> kReasons = {"few_features", "blur", "fast_motion",
                                                      "not_located", "few_points"};

bool HasWalk(CaptureAdvice::Kind kind) {
  return kind == CaptureAdvice::Kind::kOneSide ||
         (kind >= CaptureAdvice::Kind::kStepLeft && kind <= CaptureAdvice::Kind::kStepBack);
}

// Advice of a kind that has no name, or of numbers that JSON does not have, is only its sentence.
void DescribeAdvice(Fields& fields, CaptureAdvice& advice) {
  std::string sentence = fields.reading() ? "" : train::AdviceSentence(advice).English();
  fields.Text("text", sentence);
  const auto index = static_cast<size_t>(advice.kind);
  const bool finite = std::isfinite(advice.value) && std::isfinite(advice.walk.value);
  std::string kind(!fields.reading() && index < kKinds.size() && finite ? kKinds[index] : "");
  fields.Text(Optional("kind", !kind.empty()), kind);
  const auto found = std::ranges::find(kKinds, kind);
  if (fields.reading()) {
    advice.kind = static_cast<CaptureAdvice::Kind>(found - kKinds.begin());
  }
  if (found == kKinds.end()) {
    if (fields.reading()) {
      advice.text = sentence;
    }
    return;
  }
  fields.Choice(Optional("end", advice.end != CaptureAdvice::End::kNone), advice.end, kPathEnds,
                "end has no \"{}\"");
  fields.Choice(Optional("reason", advice.kind == CaptureAdvice::Kind::kNotLocated), advice.reason,
                kReasons, "reason has no \"{}\"");
  std::vector<std::string> frames = {advice.first, advice.last};
  fields.List(Optional("frames", !advice.first.empty()), frames, 2,
              [&](const FieldKey& key, std::string& frame) { fields.Text(key, frame); });
  fields.RequireAt("frames", frames.size() == 2, "must be a first and a last frame");
  if (fields.reading() && frames.size() == 2) {
    advice.first = frames[0];
    advice.last = frames[1];
  }
  fields.Number(Optional("value"), advice.value);
  const bool walk = HasWalk(advice.kind);
  const bool in_metres = fields.Has("walk_m", walk && advice.walk.in_metres);
  fields.Number(Optional("walk_m", in_metres), advice.walk.value);
  fields.Number(Optional("walk_share", walk && !in_metres), advice.walk.value);
  if (fields.reading()) {
    advice.walk.in_metres = in_metres;
  }
  fields.Integer(Optional("session", advice.kind == CaptureAdvice::Kind::kExposure), advice.session,
                 0, kMostCounted);
}

std::vector<std::string> AdviceTexts(const TrainingReport& report) {
  std::vector<std::string> texts;
  for (const CaptureAdvice& advice : report.advice) {
    texts.push_back(train::AdviceSentence(advice).English());
  }
  return texts;
}

// ------------------------------------------------------------ The report

void DescribeLastTraining(Fields& fields, TrainingReport& report) {
  fields.Text("recording", report.recording);
  fields.Integer("frames", report.frames, 0, kMostCounted);
  fields.Integer("located", report.located, 0, kMostCounted);
  fields.Integer("keyframes", report.keyframes, 0, kMostCounted);
  fields.Integer("points", report.points, 0, kMostCounted);
  fields.Number("seconds", report.seconds, 0.0);
  fields.Number("mean_error_px", report.mean_error_px, 0.0);
  fields.Number("error_95_px", report.error_95_px, 0.0);
  fields.Integer("ended", report.ended, 0, std::numeric_limits<int64_t>::max());
  fields.Number("focal_deviation_px", report.focal_deviation_px, 0.0);
  fields.List("advice", report.advice, kMostAdvice, DescribeAdvice);
}

void DescribeReport(Fields& fields, TrainingReport& report) {
  fields.Schema(kSchema);
  fields.Object("recordings", report.recordings);
  fields.List(Optional("warnings", !report.warnings.empty()), report.warnings, kMostWarnings,
              [&](const FieldKey& key, std::string& warning) { fields.Text(key, warning); });
  fields.Object(Optional("training", !report.recording.empty()), report, DescribeLastTraining);
  fields.RefuseUnknown();
}

}  // namespace

TrainingReport DescribeTraining(const PlaceRecordings& recordings,
                                const SourceDocument& recording,
                                const train::TrainResult& result,
                                std::optional<double> metres_per_unit) {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  TrainingReport report;
  report.recordings = recordings;
  report.warnings = result.report.notes;
  report.warnings.resize(std::min(report.warnings.size(), kMostWarnings));
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
  for (const std::string& advice : AdviceTexts(report)) {
    text += "- " + advice + "\n";
  }
  return text;
}

Json TrainingJson(const TrainingReport& report) {
  return {{"error_95_px", report.error_95_px},
          {"total_seconds", report.seconds},
          {"advice", AdviceTexts(report)}};
}

Result<TrainingReport> LoadTrainingReport(const std::filesystem::path& file) {
  LARARIUM_ASSIGN_OR_RETURN(const Json json, LoadJson(file));
  return ParseFields<TrainingReport>(JsonView(json, file.string()), DescribeReport,
                                     UnknownFields::kIgnore);
}

Status SaveTrainingReport(const std::filesystem::path& file, const TrainingReport& report) {
  return SaveJson(file, FormatFields(report, DescribeReport));
}

}  // namespace lararium::editor
