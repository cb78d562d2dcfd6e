#include "editor/panels/film_dialog.h"

#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "editor/panels/dialogs.h"
#include "editor/panels/gizmo_view.h"
#include "editor/panels/text.h"
#include "editor/panels/theme.h"
#include "editor/panels/widgets.h"

namespace lararium::panels {

namespace {

using train::CoverageGuide;

constexpr std::array<const char*, 5> kVideos = {".mp4", ".mov", ".mkv", ".avi", ".webm"};

ImVec4 CellColour(CoverageGuide::Cell cell) {
  switch (cell) {
    case CoverageGuide::Cell::kCovered:
      return Colours().good;
    case CoverageGuide::Cell::kSeen:
      return Colours().warning;
    case CoverageGuide::Cell::kBare:
      return Colours().line;
    case CoverageGuide::Cell::kUnseen:
      break;
  }
  return Colours().frame;
}

// The directions around the beginning, from 180 degrees to the left to 180 to the right, the sky
// above; a frame around where the camera looks.
void ShowDirections(const app::FilmMoment& moment) {
  constexpr double kHalfViewColumns = 2.0;  // about 30 degrees to either side
  const float width = ImGui::GetContentRegionAvail().x;
  const float cell = std::floor(width / CoverageGuide::kColumns);
  const float height = Px(14);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  for (int row = 0; row < CoverageGuide::kRows; ++row) {
    const float y = at.y + static_cast<float>(CoverageGuide::kRows - 1 - row) * height;
    for (int column = 0; column < CoverageGuide::kColumns; ++column) {
      const float x = at.x + static_cast<float>(column) * cell;
      const auto kind = moment.cells[static_cast<size_t>(row)][static_cast<size_t>(column)];
      const ImVec2 end(x + cell - Px(1), y + height - Px(1));
      const bool half = kind == CoverageGuide::Cell::kSeen;  // not told by its colour alone
      if (half) {
        draw.AddRectFilled(ImVec2(x, y), end, Packed(Colours().frame));
      }
      draw.AddRectFilled(ImVec2(x, half ? y + 0.5f * height : y), end, Packed(CellColour(kind)));
    }
  }
  const double heading = moment.coverage.heading / std::numbers::pi;
  const float middle =
      at.x + cell * static_cast<float>(CoverageGuide::kColumns * 0.5 * (1.0 + heading));
  const auto half = static_cast<float>(kHalfViewColumns) * cell;
  draw.AddRect(ImVec2(middle - half, at.y - Px(1)),
               ImVec2(middle + half, at.y + CoverageGuide::kRows * height), Packed(Colours().text),
               Px(2), 0, Px(1.5f));
  ImGui::Dummy(ImVec2(width, CoverageGuide::kRows * height + Px(2)));
  Hint(
      Tr("Directions, the first one in the middle: full ones were seen from places well apart, "
         "half ones from one place only."));
}

void ShowShare(const char* label, double share) {
  PropertyLabel(label);
  const std::string text = Text("%.0f %%", 100.0 * share);
  ImGui::ProgressBar(static_cast<float>(share), ImVec2(-FLT_MIN, 0), text.c_str());
}

void ShowShares(const train::CoverageShares& shares) {
  Heading(Text(Tr("%.0f %% covered"), 100.0 * shares.all()).c_str());
  ImGui::PushStyleColor(ImGuiCol_PlotHistogram, Colours().chosen);
  if (BeginProperties("shares", 150.0f)) {
    ShowShare(Tr("Ahead, to both sides"), shares.ahead);
    ShowShare(Tr("The floor"), shares.floor);
    ShowShare(Tr("Steps to the side"), shares.sideways);
    ShowShare(Tr("Nearer and farther"), shares.depth);
    EndProperties();
  }
  ImGui::PopStyleColor();
}

// The picture with what to do written over it.
void ShowPicture(EditorState& state, const app::FilmMoment& moment, const ImVec2& size) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const ImVec2 corner(at.x + size.x, at.y + size.y);
  draw.AddRectFilled(at, corner, Packed(OverPicture().window));
  if (moment.bgr != nullptr) {
    const float scale = std::min(size.x / static_cast<float>(moment.bgr->cols),
                                 size.y / static_cast<float>(moment.bgr->rows));
    const ImVec2 half(0.5f * scale * static_cast<float>(moment.bgr->cols),
                      0.5f * scale * static_cast<float>(moment.bgr->rows));
    const ImVec2 middle(at.x + 0.5f * size.x, at.y + 0.5f * size.y);
    draw.AddImage(state.pictures.Show("film", moment.bgr),
                  ImVec2(middle.x - half.x, middle.y - half.y),
                  ImVec2(middle.x + half.x, middle.y + half.y));
    const std::string fault = app::FaultText(moment.coverage.fault, true);
    ImGui::PushFont(ThemeFonts().strong);
    float y = corner.y - Px(38);
    DrawLabel(ImVec2(at.x + Px(16), y), app::AdviceText(moment.coverage.advice, true),
              Packed(OverPicture().text), draw);
    if (!fault.empty()) {
      y -= ImGui::GetTextLineHeight() + Px(10);
      DrawLabel(ImVec2(at.x + Px(16), y), fault, Packed(OverPicture().warning), draw);
    }
    ImGui::PopFont();
  }
  ImGui::Dummy(size);
}

}  // namespace

void FilmDialog::Close(EditorState& state) {
  film_.reset();
  problem_.clear();
  state.dialog = Dialog::kNone;
}

void FilmDialog::ShowStart(app::Workspace& workspace, EditorState& state) {
  Hint(
      Tr("While you film it says what to do next and how much of the place visitors need is there. "
         "It follows corners in the images; what it says is no map, and training may still find "
         "gaps."));
  if (BeginProperties("film")) {
    PropertyLabel(Tr("Place"));
    ImGui::InputText("##place", &state.fields.place);
    PropertyLabel(Tr("Camera"));
    PathField("camera", camera_, workspace.paths().folder, kVideos);
    EndProperties();
  }
  Hint(Tr("The camera's number, 0 for the first; or a video, to try it without one."));
  if (!problem_.empty()) {
    ImGui::PushStyleColor(ImGuiCol_Text, Colours().warning);
    ImGui::TextWrapped("%s", problem_.c_str());
    ImGui::PopStyleColor();
  }
  const DialogAnswer answer = DialogButtons(Tr("Film"), NameProblem(state.fields.place));
  if (answer == DialogAnswer::kCancel) {
    Close(state);
  }
  if (answer == DialogAnswer::kAct) {
    std::error_code ignored;
    const std::filesystem::path file = workspace.paths().Resolve(camera_);
    auto camera = app::OpenFilmCamera(
        std::filesystem::is_regular_file(file, ignored) ? file.string() : camera_);
    problem_ = camera.ok() ? "" : camera.message();
    if (camera.ok()) {
      const std::filesystem::path folder = workspace.paths().Place(state.fields.place);
      film_ = std::make_unique<app::FilmTask>(*std::move(camera), app::NewFilmFile(folder));
    }
  }
}

void FilmDialog::ShowFilming(app::Workspace& workspace, EditorState& state) {
  const app::FilmMoment moment = film_->moment();
  const std::optional<Status> outcome = film_->outcome();
  const float available = ImGui::GetContentRegionAvail().x;
  const float side = std::min(Px(320), 0.45f * available);
  ImVec2 picture(available - side - Px(14), 0.0f);
  picture.y = std::min(0.75f * picture.x, 0.6f * ImGui::GetMainViewport()->WorkSize.y);
  ShowPicture(state, moment, picture);
  ImGui::SameLine(0.0f, Px(14));
  ImGui::BeginGroup();
  ImGui::PushItemWidth(side);
  ImGui::BeginChild("coverage", ImVec2(side, picture.y));
  ShowShares(moment.coverage.shares);
  ImGui::Dummy(ImVec2(0, Px(6)));
  ShowDirections(moment);
  ImGui::Dummy(ImVec2(0, Px(6)));
  DimText(Text(Tr("%.0f s, %d images"), moment.seconds, static_cast<int>(moment.frames)));
  ImGui::EndChild();
  ImGui::PopItemWidth();
  ImGui::EndGroup();

  const bool failed = outcome && !outcome->ok();
  const std::string problem = failed               ? outcome->message()
                              : moment.frames == 0 ? Tr("Waiting for the camera\xe2\x80\xa6")
                                                   : "";
  const DialogAnswer answer = DialogButtons(Tr("Stop and train"), problem, Tr("Discard"));
  if (answer == DialogAnswer::kCancel) {
    Close(state);
    return;
  }
  if (answer == DialogAnswer::kAct) {
    film_->Finish();
  }
  if (outcome && outcome->ok() && film_->finishing()) {
    DialogFields fields = state.fields;
    fields.images = false;
    fields.intrinsics.clear();
    fields.file = film_->file().string();
    Close(state);
    TrainRecording(workspace, fields);
  }
}

void FilmDialog::Show(app::Workspace& workspace, EditorState& state) {
  if (state.dialog != Dialog::kFilm) {
    film_.reset();
    return;
  }
  bool open = true;
  const bool filming = film_ != nullptr;
  ShowModal(Label(Tr("Film a place"), filming ? "filming" : "film").c_str(),
            filming ? 1000.0f : 520.0f, open, [&] {
              filming ? ShowFilming(workspace, state) : ShowStart(workspace, state);
              open = state.dialog == Dialog::kFilm && filming == (film_ != nullptr);
            });
  if (!open && filming == (film_ != nullptr)) {
    Close(state);
  }
}

}  // namespace lararium::panels
