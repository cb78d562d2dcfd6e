#include "editor/jobs/calibrating.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "editor/jobs/filming.h"
#include "editor/text/text.h"
#include "shared/core/file.h"
#include "shared/core/json_fields.h"
#include "shared/core/units.h"

namespace lararium::editor {
namespace {

using train::Calibration;
using train::CalibrationAdvice;
using Kind = CalibrationAdvice::Kind;
constexpr double kLiveSeconds = 1800.0;  // Limit in the window, where the user ends it.

const char* const kParts[train::kImageParts] = {
    TrLater("the upper left corner"), TrLater("the upper edge"), TrLater("the upper right corner"),
    TrLater("the left edge"),         TrLater("the middle"),     TrLater("the right edge"),
    TrLater("the lower left corner"), TrLater("the lower edge"), TrLater("the lower right corner")};

// One sentence on what to do about parts of the image without corners.
std::string PartsText(const Calibration& calibration, bool translated) {
  std::string parts;
  for (const CalibrationAdvice& advice : calibration.advice) {
    if (advice.kind == Kind::kPart) {
      const char* part = kParts[static_cast<size_t>(advice.value)];
      parts += (parts.empty() ? "" : ", ") + std::string(translated ? Tr(part) : part);
    }
  }
  const char* text = TrLater("Hold the board there too, where hardly a corner was seen: %s.");
  return Text(translated ? Tr(text) : text, parts.c_str());
}

std::string NumberText(Kind kind, double value, bool translated) {
  const auto say = [&](const char* text, double number) {
    return Text(translated ? Tr(text) : text, number);
  };
  switch (kind) {
    case Kind::kTilt:
      return say(TrLater("Tilt the board more, by 20 to 40 degrees to all sides: the focal length "
                         "is known to %.1f %% only."),
                 100.0 * value);
    case Kind::kUneven:
      return say(TrLater("Corners are %.2f px off: lay the board on something flat and stiff, keep "
                         "focus and zoom fixed, and hold still now and then."),
                 value);
    case Kind::kHeldOut:
      return say(TrLater("Views that were held out are %.2f px off, more than those that were "
                         "fitted: film more views."),
                 value);
    case Kind::kFewViews:
      return say(TrLater("Only %.0f views that differ were fitted: show the board from more sides, "
                         "near and far."),
                 value);
    case Kind::kBlur:
      return say(TrLater("Move the board more slowly: %.0f blurred views were left out."), value);
    case Kind::kAspect:
      return say(
          TrLater("Pixels seem to be %.1f %% wider than high: look whether the recording was "
                  "stretched."),
          -100.0 * value);
    case Kind::kPart:
      break;
  }
  return "";
}

std::string VerdictName(Calibration::Verdict verdict) {
  switch (verdict) {
    case Calibration::Verdict::kGood:
      return "good";
    case Calibration::Verdict::kUsable:
      return "usable";
    case Calibration::Verdict::kPoor:
      break;
  }
  return "poor";
}

std::string PartName(train::CalibratedView::Part part) {
  switch (part) {
    case train::CalibratedView::Part::kFitted:
      return "fitted";
    case train::CalibratedView::Part::kHeldOut:
      return "held out";
    case train::CalibratedView::Part::kRejected:
      break;
  }
  return "rejected";
}

}  // namespace

std::string IntrinsicsText(const geometry::CameraModel& camera, const char* separator) {
  std::string text;
  for (const double number :
       {camera.fx, camera.fy, camera.cx, camera.cy, camera.k1, camera.k2, camera.p1, camera.p2}) {
    text += (text.empty() ? "" : separator) + Text("%.9g", number);
  }
  return text;
}

std::string VerdictText(Calibration::Verdict verdict, bool translated) {
  const auto say = [translated](const char* text) { return translated ? Tr(text) : text; };
  switch (verdict) {
    case Calibration::Verdict::kGood:
      return say(TrLater("Good: use it."));
    case Calibration::Verdict::kUsable:
      return say(TrLater("Usable; it can be better."));
    case Calibration::Verdict::kPoor:
      break;
  }
  return say(TrLater("Poor: film the board again."));
}

std::vector<std::string> AdviceTexts(const Calibration& calibration, bool translated) {
  std::vector<std::string> texts;
  bool parts = false;
  for (const CalibrationAdvice& advice : calibration.advice) {
    if (advice.kind != Kind::kPart) {
      texts.push_back(NumberText(advice.kind, advice.value, translated));
    } else if (!std::exchange(parts, true)) {
      texts.push_back(PartsText(calibration, translated));
    }
  }
  return texts;
}

std::string CalibrationText(const Calibration& calibration) {
  const geometry::CameraModel& c = calibration.camera;
  const train::CameraDeviation& d = calibration.deviation;
  std::string text = Text(
      "board: seen in %d of %d images; %d views fitted, %d held out, %d rejected; tilted up to "
      "%.0f degrees; %.0f %% of the image covered\n",
      calibration.counts.found, calibration.counts.images, calibration.fitted, calibration.held_out,
      calibration.rejected, kDegreesPerRadian * calibration.max_tilt, 100.0 * calibration.covered);
  text += Text(
      "camera: %d x %d px, focal length %.2f +- %.2f, %.2f +- %.2f px, centre %.2f +- %.2f, "
      "%.2f +- %.2f px\n",
      c.width, c.height, c.fx, d.fx, c.fy, d.fy, c.cx, d.cx, c.cy, d.cy);
  text += Text("distortion: k1 %.5f +- %.5f, k2 %.5f +- %.5f, p1 %.5f +- %.5f, p2 %.5f +- %.5f\n",
               c.k1, d.k1, c.k2, d.k2, c.p1, d.p1, c.p2, d.p2);
  text += Text("error: %.3f px, of the views held out %.3f px\n", calibration.rms_px,
               calibration.held_out_rms_px);
  text += VerdictText(calibration.verdict, false) + "\n";
  for (const std::string& advice : AdviceTexts(calibration, false)) {
    text += "- " + advice + "\n";
  }
  return text + "--intrinsics " + IntrinsicsText(c, ",") + "\n";
}

Json CalibrationJson(const Calibration& calibration) {
  const geometry::CameraModel& c = calibration.camera;
  const train::CameraDeviation& d = calibration.deviation;
  Json views = Json::array();
  for (const train::CalibratedView& view : calibration.views) {
    views.push_back({{"name", view.view.name},
                     {"part", PartName(view.part)},
                     {"rms_px", view.rms_px},
                     {"tilt_deg", kDegreesPerRadian * view.tilt},
                     {"blur_px", view.view.blur_px}});
  }
  return {{"intrinsics", std::array{c.fx, c.fy, c.cx, c.cy, c.k1, c.k2, c.p1, c.p2}},
          {"deviation", std::array{d.fx, d.fy, d.cx, d.cy, d.k1, d.k2, d.p1, d.p2}},
          {"width", c.width},
          {"height", c.height},
          {"rms_px", calibration.rms_px},
          {"held_out_rms_px", calibration.held_out_rms_px},
          {"images", calibration.counts.images},
          {"found", calibration.counts.found},
          {"blurred", calibration.counts.blurred},
          {"fitted", calibration.fitted},
          {"held_out", calibration.held_out},
          {"rejected", calibration.rejected},
          {"covered", calibration.covered},
          {"grid", calibration.grid.counts},
          {"verdict", VerdictName(calibration.verdict)},
          {"advice", AdviceTexts(calibration, false)},
          {"views", std::move(views)}};
}

Status SaveDeviceField(const std::filesystem::path& file, const char* field, const Json& value) {
  Json device = {{"schema", 1}};
  if (FileExists(file)) {
    LARARIUM_ASSIGN_OR_RETURN(device, LoadJson(file));
    const JsonView view(device, file.string());
    LARARIUM_ASSIGN_OR_RETURN(const int64_t schema, view.Integer("schema", 1, 1'000'000));
    if (schema != 1) {
      return view.Problem("was written for a newer editor", "update the editor");
    }
  }
  device[field] = value;
  return SaveJson(file, device);
}

Status SaveDeviceCamera(const std::filesystem::path& file, const geometry::CameraModel& camera) {
  return SaveDeviceField(file, "camera", FormatFields(camera));
}

Result<std::string> BoardSvg(train::Board board) {
  constexpr double kLong = 297.0;  // The long side of A4, mm.
  constexpr double kShort = 210.0;
  constexpr double kMargin = 12.0;
  constexpr double kFoot = 14.0;  // Mm; space for the line of text.
  constexpr double kLeast = 5.0;
  constexpr double kRuler = 100.0;
  LARARIUM_RETURN_IF_ERROR(board.Validate());
  const bool upright = board.rows > board.columns;
  const double width = upright ? kShort : kLong;
  const double height = upright ? kLong : kShort;
  const int columns = board.columns + 1;
  const int rows = board.rows + 1;
  const double fits = std::floor(
      std::min((width - 2.0 * kMargin) / columns, (height - 2.0 * kMargin - kFoot) / rows));
  const double square = board.square > 0.0 ? 1000.0 * board.square : fits;
  if (square > fits || square < kLeast) {
    return Status::Error(board.Text(), Text("does not fit on A4 with squares of %.4g mm", square),
                         fits < kLeast ? "take a smaller board"
                                       : Text("take squares of %.0f to %.0f mm", kLeast, fits));
  }
  std::string svg = Text(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%.0fmm\" height=\"%.0fmm\" "
      "viewBox=\"0 0 %.0f %.0f\">\n<rect width=\"100%%\" height=\"100%%\" fill=\"#fff\"/>\n"
      "<path fill=\"#000\" d=\"",
      width, height, width, height);
  const double left = 0.5 * (width - square * columns);
  const double top = 0.5 * (height - kFoot - square * rows);
  for (int row = 0; row < rows; ++row) {
    for (int column = row % 2; column < columns; column += 2) {
      svg += Text("M%.4g %.4gh%.4gv%.4gh-%.4gz", left + square * column, top + square * row, square,
                  square, square);
    }
  }
  const double foot = height - kMargin;
  svg += Text(
      "\"/>\n<path stroke=\"#000\" stroke-width=\"0.3\" d=\"M%.4g %.4gh%.0fm0 -2v4m-%.0f "
      "-4v4\"/>\n",
      left, foot - 1.0, kRuler, kRuler);
  svg += Text(
      "<text x=\"%.4g\" y=\"%.4g\" font-family=\"sans-serif\" font-size=\"4\">%d x %d, "
      "squares of %.4g mm. Print at 100 %%: the line is 100 mm long.</text>\n</svg>\n",
      left + kRuler + 4.0, foot, board.columns, board.rows, square);
  return svg;
}

CalibrationTask::CalibrationTask(std::unique_ptr<capture::FrameSource> source,
                                 const train::Board& board)
    : live_(source->live()),
      task_(TaskKind::kCalibrating,
            [this, board, source = std::shared_ptr<capture::FrameSource>(std::move(source))](
                Progress& progress) { return Run(*source, board, progress); }) {}

CalibrationMoment CalibrationTask::moment() const {
  const std::lock_guard lock(mutex_);
  return moment_;
}

Status CalibrationTask::Run(capture::FrameSource& source,
                            const train::Board& board,
                            Progress& progress) {
  const auto next = [this](const train::BoardMoment& seen) {
    CalibrationMoment moment;
    moment.bgr = std::make_shared<const cv::Mat>(seen.frame.bgr.clone());
    moment.corners = seen.views.corners();
    moment.observation = seen.observation;
    moment.grid = seen.views.grid();
    moment.counts = seen.views.counts();
    moment.kept = static_cast<int>(seen.views.kept());
    const std::lock_guard lock(mutex_);
    moment_ = std::move(moment);
    return !finish_;
  };
  LARARIUM_ASSIGN_OR_RETURN(result_,
                            train::CalibrateFromBoard(source, board, kLiveSeconds, progress, next));
  return Status();
}

namespace {

Result<std::unique_ptr<capture::FrameSource>> OpenRecording(const CalibrateOptions& options) {
  if (!options.video.empty()) {
    return capture::OpenVideo(options.video);
  }
  if (!options.images.empty()) {
    return capture::OpenImageFolder(options.images);
  }
  return OpenFilmCamera(options.camera);
}

}  // namespace

Result<CommandResult> RunCalibrate(const CalibrateOptions& options, Progress& progress) {
  const train::Board board{options.columns, options.rows, options.square};
  LARARIUM_RETURN_IF_ERROR(board.Validate());
  if (!options.print_board.empty()) {
    LARARIUM_ASSIGN_OR_RETURN(const std::string svg, BoardSvg(board));
    LARARIUM_RETURN_IF_ERROR(WriteFileAtomically(options.print_board, svg));
    return CommandResult{"wrote " + options.print_board.string() +
                             "; print it at 100 % on A4 and lay it on something flat and stiff\n",
                         {{"board", options.print_board.string()}}};
  }
  LARARIUM_ASSIGN_OR_RETURN(const auto source, OpenRecording(options));
  LARARIUM_ASSIGN_OR_RETURN(const Calibration calibration,
                            train::CalibrateFromBoard(*source, board, options.seconds, progress));
  if (!options.device_out.empty()) {
    LARARIUM_RETURN_IF_ERROR(SaveDeviceCamera(options.device_out, calibration.camera));
  }
  CommandResult result{CalibrationText(calibration), CalibrationJson(calibration)};
  AddWarnings(source->Notes(), result);
  result.failed = calibration.verdict == Calibration::Verdict::kPoor;
  return result;
}

}  // namespace lararium::editor
