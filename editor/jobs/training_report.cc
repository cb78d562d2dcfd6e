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

// ------------------------------------------------------------ Advice

using train::CaptureAdvice;

constexpr std::array<std::pair<CaptureAdvice::Kind, const char*>, 13> kKinds = {{
    {CaptureAdvice::Kind::kEnough, "enough"},
    {CaptureAdvice::Kind::kNotLocated, "not_located"},
    {CaptureAdvice::Kind::kShortGaps, "short_gaps"},
    {CaptureAdvice::Kind::kOneSide, "one_side"},
    {CaptureAdvice::Kind::kStepLeft, "step_left"},
    {CaptureAdvice::Kind::kStepRight, "step_right"},
    {CaptureAdvice::Kind::kStepNearer, "step_nearer"},
    {CaptureAdvice::Kind::kStepBack, "step_back"},
    {CaptureAdvice::Kind::kTurnLeft, "turn_left"},
    {CaptureAdvice::Kind::kTurnRight, "turn_right"},
    {CaptureAdvice::Kind::kFocal, "focal"},
    {CaptureAdvice::Kind::kFewKeyframes, "few_keyframes"},
    {CaptureAdvice::Kind::kExposure, "exposure"},
}};
constexpr std::array<std::pair<CaptureAdvice::End, const char*>, 4> kPathEnds = {{
    {CaptureAdvice::End::kLeft, "left"},
    {CaptureAdvice::End::kRight, "right"},
    {CaptureAdvice::End::kNear, "near"},
    {CaptureAdvice::End::kFar, "far"},
}};
constexpr std::array<std::pair<train::WeakReason, const char*>, 5> kReasons = {{
    {train::WeakReason::kFewFeatures, "few_features"},
    {train::WeakReason::kBlur, "blur"},
    {train::WeakReason::kFastMotion, "fast_motion"},
    {train::WeakReason::kNotLocated, "not_located"},
    {train::WeakReason::kFewPoints, "few_points"},
}};

template <typename Table, typename Value>
const char* NameIn(const Table& table, Value value) {
  const auto found = std::ranges::find(table, value, [](const auto& entry) { return entry.first; });
  return found != table.end() ? found->second : nullptr;
}

// Keeps value where the field is missing.
template <typename Table, typename Value>
Status ParseName(const JsonView& view, const char* key, const Table& table, Value& value) {
  if (!view.Has(key)) {
    return Status();
  }
  LARARIUM_ASSIGN_OR_RETURN(const std::string name, view.Text(key));
  const auto found = std::ranges::find_if(table, [&](const auto& e) { return name == e.second; });
  if (found == table.end()) {
    return view.Problem(std::string(key) + " has no \"" + name + "\"");
  }
  value = found->first;
  return Status();
}

Status ParseNumber(const JsonView& view, const char* key, double& value) {
  if (view.Has(key)) {
    LARARIUM_ASSIGN_OR_RETURN(value, view.Number(key));
  }
  return Status();
}

Result<CaptureAdvice> ParseAdvice(const JsonView& view) {
  CaptureAdvice advice{.kind = CaptureAdvice::Kind::kWritten};
  LARARIUM_ASSIGN_OR_RETURN(const std::string text, view.Text("text"));
  if (!view.Has("kind")) {
    advice.text = text;
    return advice;
  }
  LARARIUM_RETURN_IF_ERROR(ParseName(view, "kind", kKinds, advice.kind));
  LARARIUM_RETURN_IF_ERROR(ParseName(view, "end", kPathEnds, advice.end));
  LARARIUM_RETURN_IF_ERROR(ParseName(view, "reason", kReasons, advice.reason));
  if (view.Has("frames")) {
    LARARIUM_ASSIGN_OR_RETURN(const JsonView frames, view.Field("frames"));
    LARARIUM_ASSIGN_OR_RETURN(const std::vector<JsonView> names, frames.Array(2));
    if (names.size() != 2) {
      return frames.Problem("must be a first and a last frame");
    }
    LARARIUM_ASSIGN_OR_RETURN(advice.first, names[0].Text());
    LARARIUM_ASSIGN_OR_RETURN(advice.last, names[1].Text());
  }
  LARARIUM_RETURN_IF_ERROR(ParseNumber(view, "value", advice.value));
  advice.walk.in_metres = view.Has("walk_m");
  LARARIUM_RETURN_IF_ERROR(ParseNumber(view, "walk_m", advice.walk.value));
  LARARIUM_RETURN_IF_ERROR(ParseNumber(view, "walk_share", advice.walk.value));
  if (view.Has("session")) {
    LARARIUM_ASSIGN_OR_RETURN(const int64_t session, view.Integer("session", 0, kMostCounted));
    advice.session = static_cast<int>(session);
  }
  return advice;
}

bool HasWalk(CaptureAdvice::Kind kind) {
  return kind == CaptureAdvice::Kind::kOneSide ||
         (kind >= CaptureAdvice::Kind::kStepLeft && kind <= CaptureAdvice::Kind::kStepBack);
}

Json FormatAdvice(const CaptureAdvice& advice) {
  Json json = {{"text", train::AdviceSentence(advice).English()}};
  const bool finite = std::isfinite(advice.value) && std::isfinite(advice.walk.value);
  const char* kind = NameIn(kKinds, advice.kind);
  if (kind == nullptr || !finite) {  // Such advice keeps only its sentence.
    return json;
  }
  json["kind"] = kind;
  json["value"] = advice.value;
  if (!advice.first.empty()) {
    json["frames"] = {advice.first, advice.last};
  }
  if (const char* end = NameIn(kPathEnds, advice.end)) {
    json["end"] = end;
  }
  if (advice.kind == CaptureAdvice::Kind::kNotLocated) {
    json["reason"] = NameIn(kReasons, advice.reason);
  }
  if (HasWalk(advice.kind)) {
    json[advice.walk.in_metres ? "walk_m" : "walk_share"] = advice.walk.value;
  }
  if (advice.kind == CaptureAdvice::Kind::kExposure) {
    json["session"] = advice.session;
  }
  return json;
}

std::vector<std::string> AdviceTexts(const TrainingReport& report) {
  std::vector<std::string> texts;
  for (const CaptureAdvice& advice : report.advice) {
    texts.push_back(train::AdviceSentence(advice).English());
  }
  return texts;
}

// ------------------------------------------------------------ The report

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
    LARARIUM_ASSIGN_OR_RETURN(report.advice.emplace_back(), ParseAdvice(entry));
  }
  return Status();
}

Json FormatTraining(const TrainingReport& report) {
  Json advice = Json::array();
  for (const CaptureAdvice& one : report.advice) {
    advice.push_back(FormatAdvice(one));
  }
  Json json = {{"recording", report.recording},     {"frames", report.frames},
               {"located", report.located},         {"keyframes", report.keyframes},
               {"points", report.points},           {"ended", report.ended},
               {"seconds", report.seconds},         {"mean_error_px", report.mean_error_px},
               {"error_95_px", report.error_95_px}, {"advice", std::move(advice)}};
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
  const JsonView view(json, file.string());
  LARARIUM_RETURN_IF_ERROR(view.CheckFields({"schema", "recordings", "training"}));
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

}  // namespace lararium::editor
