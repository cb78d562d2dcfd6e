#include "editor/panels/dialogs/calibration_dialog.h"

#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "editor/jobs/filming.h"
#include "editor/panels/dialogs/dialogs.h"
#include "editor/panels/viewport/gizmo_view.h"
#include "editor/panels/widgets/text.h"
#include "editor/panels/widgets/theme.h"
#include "editor/panels/widgets/widgets.h"
#include "shared/core/file.h"

namespace lararium::panels {

namespace {

using train::BoardObservation;
using train::CalibratedView;
using train::Calibration;
using train::CornerGrid;

constexpr int kFewestViews = static_cast<int>(train::kFewestViews);

const char* ObservationText(BoardObservation observation) {
  switch (observation) {
    case BoardObservation::kNone:
      return Tr("No board is seen");
    case BoardObservation::kBlurred:
      return Tr("Blurred: move more slowly");
    case BoardObservation::kAlike:
      return Tr("As before: move on, or tilt the board");
    case BoardObservation::kKept:
      break;
  }
  return Tr("A new view");
}

// The colour of a cell for its number of corners.
ImVec4 CellColour(int corners) {
  constexpr float kMany = 12.0f;
  const float share = std::min(1.0f, std::sqrt(static_cast<float>(corners) / kMany));
  const ImVec4 from = corners > 0 ? Colours().line : Colours().frame;
  const ImVec4 to = Colours().good;
  const float part = corners > 0 ? 0.35f + 0.65f * share : 0.0f;
  return {from.x + part * (to.x - from.x), from.y + part * (to.y - from.y),
          from.z + part * (to.z - from.z), 1.0f};
}

// Draws the cells of the image, brighter where more corners were found.
void DrawGrid(const CornerGrid& grid, const ImVec2& at, const ImVec2& size, float alpha) {
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const ImVec2 cell(size.x / CornerGrid::kColumns, size.y / CornerGrid::kRows);
  for (int row = 0; row < CornerGrid::kRows; ++row) {
    for (int column = 0; column < CornerGrid::kColumns; ++column) {
      const ImVec2 from(at.x + static_cast<float>(column) * cell.x,
                        at.y + static_cast<float>(row) * cell.y);
      const int count = grid.counts[static_cast<size_t>(row)][static_cast<size_t>(column)];
      draw.AddRectFilled(from, ImVec2(from.x + cell.x - Px(1), from.y + cell.y - Px(1)),
                         Packed(CellColour(count), alpha));
    }
  }
}

void DrawGrid(const CornerGrid& grid, float width, float aspect) {
  const ImVec2 size(width, width / aspect);
  DrawGrid(grid, ImGui::GetCursorScreenPos(), size, 1.0f);
  ImGui::Dummy(size);
}

// The picture with its corners, connected row by row.
void DrawPicture(PictureTextures& pictures,
                 const editor::CalibrationMoment& moment,
                 const train::Board& board,
                 const ImVec2& size) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const ImVec2 corner(at.x + size.x, at.y + size.y);
  draw.AddRectFilled(at, corner, Packed(OverPicture().window));
  if (moment.bgr != nullptr) {
    const PictureRect rect = FitPicture(at, size, moment.bgr->cols, moment.bgr->rows);
    const float scale = rect.size.x / static_cast<float>(moment.bgr->cols);
    draw.AddImage(pictures.Show("calibration", moment.bgr), rect.origin, rect.corner());
    const bool good = moment.observation == BoardObservation::kKept ||
                      moment.observation == BoardObservation::kAlike;
    const ImVec4 colour = good ? OverPicture().good : OverPicture().warning;
    std::vector<ImVec2> points;
    for (const Eigen::Vector2d& pixel : moment.corners) {
      points.emplace_back(rect.origin.x + scale * (static_cast<float>(pixel.x()) + 0.5f),
                          rect.origin.y + scale * (static_cast<float>(pixel.y()) + 0.5f));
      draw.AddCircle(points.back(), Px(4), Packed(colour), 12, Px(1.5f));
    }
    for (size_t i = 1; i < points.size(); ++i) {
      if (i % static_cast<size_t>(board.columns) != 0) {
        draw.AddLine(points[i - 1], points[i], Packed(colour, 0.6f), Px(1));
      }
    }
    ImGui::PushFont(ThemeFonts().strong);
    DrawLabel(ImVec2(at.x + Px(16), corner.y - Px(38)), ObservationText(moment.observation),
              Packed(good ? OverPicture().text : OverPicture().warning), draw);
    ImGui::PopFont();
  }
  ImGui::Dummy(size);
}

// A progress bar with the remaining time.
void DrawProgress(const editor::BackgroundTask::State& state) {
  std::string text = Tr(state.step.c_str());
  if (const auto left = editor::EstimateSecondsLeft(state.fraction, state.seconds)) {
    text += ", " + Text(Tr("%s left"), editor::FormatDuration(*left).c_str());
  }
  DimText(text);
  ImGui::PushStyleColor(ImGuiCol_PlotHistogram, Colours().accent);
  ImGui::ProgressBar(static_cast<float>(state.fraction), ImVec2(-FLT_MIN, Px(6)), "");
  ImGui::PopStyleColor();
}

ImVec4 ErrorColour(const CalibratedView& view) {
  switch (view.part) {
    case CalibratedView::Part::kFitted:
      return Colours().good;
    case CalibratedView::Part::kHeldOut:
      return kAxisColours[2];
    case CalibratedView::Part::kRejected:
      break;
  }
  return Colours().warning;
}

const char* PartText(CalibratedView::Part part) {
  switch (part) {
    case CalibratedView::Part::kFitted:
      return Tr("fitted");
    case CalibratedView::Part::kHeldOut:
      return Tr("held out");
    case CalibratedView::Part::kRejected:
      break;
  }
  return Tr("rejected");
}

// All corners over the image; those of the view under the pointer are enlarged.
void DrawCoverage(const Calibration& calibration, float width, int pointed) {
  const float scale = width / static_cast<float>(calibration.camera.width);
  const ImVec2 size(width, scale * static_cast<float>(calibration.camera.height));
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw.AddRectFilled(at, ImVec2(at.x + size.x, at.y + size.y), Packed(OverPicture().window));
  DrawGrid(calibration.grid, at, size, 0.35f);
  for (size_t i = 0; i < calibration.views.size(); ++i) {
    const CalibratedView& view = calibration.views[i];
    const bool strong = static_cast<int>(i) == pointed;
    for (const Eigen::Vector2d& corner : view.view.corners) {
      draw.AddCircleFilled(ImVec2(at.x + scale * (static_cast<float>(corner.x()) + 0.5f),
                                  at.y + scale * (static_cast<float>(corner.y()) + 0.5f)),
                           Px(strong ? 4.0f : 1.5f),
                           Packed(strong ? OverPicture().text : ErrorColour(view)));
    }
  }
  ImGui::Dummy(size);
}

// The shape of the bar also shows whether a view was used.
void DrawErrorBar(
    const CalibratedView& view, const ImVec2& a, const ImVec2& b, float opacity, ImDrawList& draw) {
  const ImU32 colour = Packed(ErrorColour(view), opacity);
  switch (view.part) {
    case CalibratedView::Part::kFitted:
      draw.AddRectFilled(a, b, colour);
      return;
    case CalibratedView::Part::kHeldOut:
      draw.AddRect(a, b, colour, 0.0f, 0, Px(1.5f));
      return;
    case CalibratedView::Part::kRejected:
      draw.AddLine(a, b, colour, Px(1.5f));
      draw.AddLine(ImVec2(a.x, b.y), ImVec2(b.x, a.y), colour, Px(1.5f));
      return;
  }
}

// A bar for each view with its error as height. Returns the view under the pointer, or -1.
int DrawErrors(const Calibration& calibration, const ImVec2& size) {
  double highest = 1e-9;
  for (const CalibratedView& view : calibration.views) {
    if (view.part != CalibratedView::Part::kRejected) {
      highest = std::max(highest, view.rms_px);
    }
  }
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  ImGui::InvisibleButton("errors", size);
  const bool hovered = ImGui::IsItemHovered();
  const float step = size.x / static_cast<float>(std::max<size_t>(1, calibration.views.size()));
  int pointed = -1;
  for (size_t i = 0; i < calibration.views.size(); ++i) {
    const CalibratedView& view = calibration.views[i];
    const float left = at.x + static_cast<float>(i) * step;
    const auto share = static_cast<float>(std::min(1.0, view.rms_px / highest));
    const float mouse = ImGui::GetIO().MousePos.x;
    const bool here = hovered && mouse >= left && mouse < left + step;
    DrawErrorBar(view, ImVec2(left, at.y + size.y * (1.0f - share)),
                 ImVec2(left + std::max(1.0f, step - Px(2)), at.y + size.y), here ? 1.0f : 0.8f,
                 draw);
    if (here) {
      pointed = static_cast<int>(i);
      ImGui::SetTooltip(Tr("%s: %.3f px, %s, tilted by %.0f degrees"), view.view.name.c_str(),
                        view.rms_px, PartText(view.part), view.tilt * 180.0 / std::numbers::pi);
    }
  }
  DimText(
      Text(Tr("Error of each view, up to %.2f px; hollow: held out, crossed: rejected"), highest));
  return pointed;
}

void DrawNumbers(const Calibration& calibration) {
  const geometry::CameraModel& c = calibration.camera;
  const train::CameraDeviation& d = calibration.deviation;
  if (BeginProperties("calibration", 110.0f)) {
    PropertyText(Tr("Image"), Text("%d \xc3\x97 %d", c.width, c.height));
    PropertyText(Tr("Focal"), Text("%.1f \xc2\xb1 %.1f px (%.2f %%)", c.fx, d.fx,
                                   100.0 * calibration.FocalDeviation()));
    PropertyText("", Text("%.1f \xc2\xb1 %.1f px", c.fy, d.fy));
    PropertyText(Tr("Centre"),
                 Text("%.1f \xc2\xb1 %.1f, %.1f \xc2\xb1 %.1f px", c.cx, d.cx, c.cy, d.cy));
    PropertyText(Tr("Distortion"), Text("%.4f \xc2\xb1 %.4f", c.k1, d.k1));
    PropertyText("", Text("%.4f \xc2\xb1 %.4f", c.k2, d.k2));
    PropertyText(Tr("Error"), Text("%.3f px", calibration.rms_px));
    PropertyText(Tr("Held out"),
                 Text(Tr("%.3f px, %d views"), calibration.held_out_rms_px, calibration.held_out));
    PropertyText(Tr("Views"),
                 Text(Tr("%d fitted, %d rejected"), calibration.fitted, calibration.rejected));
    PropertyText(Tr("Covered"), Text("%.0f %%", 100.0 * calibration.covered));
    EndProperties();
  }
}

void DrawVerdict(const Calibration& calibration) {
  const bool good = calibration.verdict == Calibration::Verdict::kGood;
  ImGui::PushStyleColor(ImGuiCol_Text, good ? Colours().text : Colours().warning);
  Heading(editor::VerdictText(calibration.verdict, true).c_str());
  ImGui::PopStyleColor();
  for (const std::string& advice : editor::AdviceTexts(calibration, true)) {
    Hint(advice);
  }
}

}  // namespace

void CalibrationDialog::Clear() {
  task_.reset();
  problem_.clear();
  written_.clear();
}

void CalibrationDialog::DrawSource(const editor::ProjectPaths& paths) {
  PropertyLabel(Tr("Board in"));
  const char* const kinds[] = {Tr("Video"), Tr("Folder of images"), Tr("Live camera")};
  Segmented("source", kinds, source_);
  const auto source = static_cast<Source>(source_);
  if (source == Source::kCamera) {
    camera_.Show(files_[source_], paths.folder);
    return;
  }
  PropertyLabel(source == Source::kVideo ? Tr("File") : Tr("Folder"));
  PathField("file", files_[source_], paths.folder,
            source == Source::kImages ? FileType::kImages : FileType::kVideo);
}

void CalibrationDialog::WriteBoard(const editor::ProjectPaths& paths) {
  const std::filesystem::path file = paths.folder / ("board-" + std::to_string(board_.columns) +
                                                     "x" + std::to_string(board_.rows) + ".svg");
  const Result<std::string> svg = editor::BoardSvg(board_);
  const Status status = svg.ok() ? WriteFileAtomically(file, *svg) : svg.status();
  problem_ = status.message();
  written_ = status.ok() ? file.string() : "";
}

void CalibrationDialog::Begin(const editor::ProjectPaths& paths) {
  const std::filesystem::path file = paths.Resolve(files_[source_]);
  std::error_code ignored;
  auto source = static_cast<Source>(source_) == Source::kVideo ? capture::OpenVideo(file)
                : static_cast<Source>(source_) == Source::kImages
                    ? capture::OpenImageFolder(file)
                    : editor::OpenFilmCamera(std::filesystem::is_regular_file(file, ignored)
                                                 ? file.string()
                                                 : files_[source_]);
  problem_ = source.ok() ? "" : source.message();
  if (source.ok()) {
    task_ = std::make_unique<editor::CalibrationTask>(*std::move(source), board_);
  }
}

void CalibrationDialog::DrawStart(const editor::ProjectPaths& paths) {
  Hint(
      Tr("Move a chessboard through all of the image, near and far, tilted to all sides, slowly, "
         "with the size, focus and zoom that the place is filmed with. Half a minute is enough."));
  if (BeginProperties("calibrate")) {
    DrawSource(paths);
    PropertyLabel(Tr("Board"));
    const float width = Px(96);
    ImGui::SetNextItemWidth(width);
    ImGui::InputInt("##columns", &board_.columns);
    ImGui::SameLine();
    ImGui::TextUnformatted("\xc3\x97");
    ImGui::SameLine();
    ImGui::SetNextItemWidth(width);
    ImGui::InputInt("##rows", &board_.rows);
    ImGui::SameLine();
    DimText(Tr("inner corners"));
    EndProperties();
  }
  if (static_cast<Source>(source_) == Source::kCamera) {
    camera_.DrawHint();
  }
  Hint(Tr("Inner corners are where four squares meet: 10 \xc3\x97 7 squares have 9 \xc3\x97 6."));
  if (ImGui::Button(Tr("Write a board to print"), ImVec2(-FLT_MIN, 0))) {
    WriteBoard(paths);
  }
  if (!written_.empty()) {
    Hint(Text(Tr("Print %s at 100 %% on A4, and lay it on something flat and stiff."),
              written_.c_str()));
  }
  WarningText(problem_);
  const DialogProblem problem =
      !board_.Validate().ok()   ? Wrong(Tr("A side has 3 to 40 inner corners."))
      : files_[source_].empty() ? Missing(Tr("Choose what shows the board."))
                                : DialogProblem();
  const DialogAnswer answer = DialogButtons(Tr("Calibrate"), problem);
  if (answer == DialogAnswer::kCancel) {
    open_ = false;
  }
  if (answer == DialogAnswer::kAct) {
    Begin(paths);
  }
}

void CalibrationDialog::DrawSearch(PictureTextures& pictures) {
  const editor::CalibrationMoment moment = task_->moment();
  const float available = ImGui::GetContentRegionAvail().x;
  const float side = std::min(Px(320), 0.45f * available);
  ImVec2 picture(available - side - Px(14), 0.0f);
  picture.y = std::min(0.75f * picture.x, 0.6f * ImGui::GetMainViewport()->WorkSize.y);
  DrawPicture(pictures, moment, board_, picture);
  ImGui::SameLine(0.0f, Px(14));
  ImGui::BeginChild("found", ImVec2(side, picture.y));
  Heading(Text(Tr("%d views that differ"), moment.kept).c_str());
  DimText(Text(Tr("Board in %d of %d images, %d of them blurred"), moment.counts.found,
               moment.counts.images, moment.counts.blurred));
  ImGui::Dummy(ImVec2(0, Px(6)));
  const float aspect = moment.bgr == nullptr ? 4.0f / 3.0f
                                             : static_cast<float>(moment.bgr->cols) /
                                                   static_cast<float>(moment.bgr->rows);
  DrawGrid(moment.grid, side, aspect);
  Hint(Tr("Where corners were seen: fill all of it, its corners too."));
  ImGui::Dummy(ImVec2(0, Px(6)));
  const editor::BackgroundTask::State state = task_->state();
  // A live camera has no progress: the user ends it.
  const bool calibrating = task_->finishing() || state.step == "calibrating";
  if (!task_->live() || calibrating) {
    DrawProgress(state);
  }
  ImGui::EndChild();

  DialogProblem problem;
  if (calibrating) {
    problem = Missing(Tr("Calibrating\xe2\x80\xa6"));
  } else if (moment.kept < kFewestViews) {
    problem = Missing(Text(Tr("%d views that differ are needed at least."), kFewestViews));
  }
  const DialogAnswer answer = DialogButtons(Tr("Stop and calibrate"), problem);
  if (answer == DialogAnswer::kAct) {
    task_->Finish();
  }
  const std::optional<Status> outcome = task_->outcome();
  if (answer == DialogAnswer::kCancel || (outcome && !outcome->ok())) {
    problem_ = answer == DialogAnswer::kCancel ? "" : outcome->message();
    task_.reset();
  }
}

void CalibrationDialog::Use(const editor::ProjectPaths& paths, DialogFields& fields) {
  geometry::CameraModel camera = task_->result().camera;
  const std::filesystem::path file = paths.Resolve(fields.file);
  if (!fields.file.empty() && FileExists(file)) {
    const auto source = fields.images ? capture::OpenImageFolder(file) : capture::OpenVideo(file);
    const auto fitting = source.ok() ? camera.ForImages((*source)->width(), (*source)->height())
                                     : Result<geometry::CameraModel>(source.status());
    if (!fitting.ok()) {
      problem_ = fitting.message();
      return;
    }
    camera = *fitting;
  }
  fields.intrinsics = editor::IntrinsicsText(camera);
  open_ = false;
}

void CalibrationDialog::DrawResult(const editor::ProjectPaths& paths, DialogFields& fields) {
  const Calibration& calibration = task_->result();
  const float available = ImGui::GetContentRegionAvail().x;
  const float side = std::min(Px(400), 0.5f * available);
  const float width = available - side - Px(18);
  ImGui::BeginGroup();
  const ImVec2 map = ImGui::GetCursorPos();
  const float height = width * static_cast<float>(calibration.camera.height) /
                       static_cast<float>(calibration.camera.width);
  // The bars come first, because they determine the view that the map shows.
  ImGui::SetCursorPosY(map.y + height + Px(8));
  const int pointed = DrawErrors(calibration, ImVec2(width, Px(64)));
  const ImVec2 end = ImGui::GetCursorPos();
  ImGui::SetCursorPos(map);
  DrawCoverage(calibration, width, pointed);
  ImGui::SetCursorPos(end);
  ImGui::EndGroup();
  ImGui::SameLine(0.0f, Px(18));
  ImGui::BeginChild("numbers", ImVec2(side, height + Px(110)));
  DrawVerdict(calibration);
  ImGui::Dummy(ImVec2(0, Px(6)));
  DrawNumbers(calibration);
  ImGui::EndChild();
  WarningText(problem_);
  const DialogAnswer answer = DialogButtons(Tr("Use them"), {}, Tr("Film again"));
  if (answer == DialogAnswer::kCancel) {
    Clear();
  }
  if (answer == DialogAnswer::kAct) {
    Use(paths, fields);
  }
}

CalibrationDialog::Page CalibrationDialog::page() const {
  if (task_ == nullptr) {
    return Page::kStart;
  }
  const std::optional<Status> outcome = task_->outcome();
  return outcome && outcome->ok() ? Page::kResult : Page::kSearch;
}

void CalibrationDialog::Show(const editor::ProjectPaths& paths,
                             PictureTextures& pictures,
                             DialogFields& fields) {
  const Page shown = page();
  bool open = true;
  const char* const ids[] = {"calibrate", "calibrating", "calibrated"};
  DrawModal(Label(Tr("Calibrate a camera"), ids[static_cast<int>(shown)]).c_str(),
            shown == Page::kStart ? 520.0f : 1000.0f, open, [&] {
              switch (shown) {
                case Page::kStart:
                  DrawStart(paths);
                  break;
                case Page::kSearch:
                  DrawSearch(pictures);
                  break;
                case Page::kResult:
                  DrawResult(paths, fields);
                  break;
              }
              open = open_ && shown == page();
            });
  if (!open && shown == page()) {
    open_ = false;
  }
  if (!open_) {
    Clear();
  }
}

}  // namespace lararium::panels
