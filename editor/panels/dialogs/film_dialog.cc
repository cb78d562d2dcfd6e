#include "editor/panels/dialogs/film_dialog.h"

#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "editor/panels/viewport/gizmo_view.h"
#include "editor/panels/widgets/text.h"
#include "editor/panels/widgets/theme.h"
#include "editor/panels/widgets/widgets.h"

namespace lararium::panels {

namespace {

using train::CoverageGuide;

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

// The directions relative to the beginning, from 180 degrees left to 180 degrees right, with the
// sky at the top, and a frame around the present view.
void DrawDirections(const editor::FilmMoment& moment) {
  constexpr double kHalfViewColumns = 2.0;  // About 30 degrees to either side.
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
      // Also recognisable without its colour.
      const bool half = kind == CoverageGuide::Cell::kSeen;
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

void DrawShare(const char* label, double share) {
  PropertyLabel(label);
  const std::string text = Text("%.0f %%", 100.0 * share);
  ImGui::ProgressBar(static_cast<float>(share), ImVec2(-FLT_MIN, 0), text.c_str());
}

void DrawShares(const train::CoverageShares& shares) {
  Heading(Text(Tr("%.0f %% covered"), 100.0 * shares.all()).c_str());
  ImGui::PushStyleColor(ImGuiCol_PlotHistogram, Colours().chosen);
  if (BeginProperties("shares", 150.0f)) {
    DrawShare(Tr("Ahead, to both sides"), shares.ahead);
    DrawShare(Tr("The floor"), shares.floor);
    DrawShare(Tr("Steps to the side"), shares.sideways);
    DrawShare(Tr("Nearer and farther"), shares.depth);
    EndProperties();
  }
  ImGui::PopStyleColor();
}

// The picture with the next step written over it.
void DrawPicture(PictureTextures& pictures, const editor::FilmMoment& moment, const ImVec2& size) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const ImVec2 corner(at.x + size.x, at.y + size.y);
  draw.AddRectFilled(at, corner, Packed(OverPicture().window));
  if (moment.bgr != nullptr) {
    const PictureRect rect = FitPicture(at, size, moment.bgr->cols, moment.bgr->rows);
    draw.AddImage(pictures.Show("film", moment.bgr), rect.origin, rect.corner());
    const std::string fault = editor::FaultText(moment.coverage.fault, true);
    ImGui::PushFont(ThemeFonts().strong);
    float y = corner.y - Px(38);
    DrawLabel(ImVec2(at.x + Px(16), y), editor::AdviceText(moment.coverage.advice, true),
              Packed(OverPicture().text), draw);
    if (!fault.empty()) {
      y -= ImGui::GetTextLineHeight() + Px(10);
      DrawLabel(ImVec2(at.x + Px(16), y), fault, Packed(OverPicture().warning), draw);
    }
    ImGui::PopFont();
  }
  ImGui::Dummy(size);
}

// Left of the buttons that keep the film.
bool DiscardButton() {
  ImGui::SameLine(ImGui::GetStyle().WindowPadding.x);
  const bool pressed = ImGui::Button(Tr("Discard"));
  Tip(Tr("Deletes what was filmed"));
  return pressed;
}

}  // namespace

void FilmDialog::Close(Dialogs& dialogs) {
  film_.reset();
  problem_.clear();
  asks_ = false;
  dialogs.shown = Dialog::kNone;
}

void FilmDialog::Discard(Dialogs& dialogs) {
  film_->Discard();
  Close(dialogs);
}

void FilmDialog::Begin(editor::Workspace& workspace, const TitledName& place) {
  std::error_code ignored;
  const std::filesystem::path file = workspace.project().paths().Resolve(camera_);
  auto camera = editor::OpenFilmCamera(
      std::filesystem::is_regular_file(file, ignored) ? file.string() : camera_);
  problem_ = camera.ok() ? "" : camera.message();
  if (camera.ok()) {
    place_ = place;
    asks_ = false;
    const std::filesystem::path folder = workspace.project().paths().Place(place.name);
    film_ = std::make_unique<editor::FilmTask>(*std::move(camera), editor::NewFilmFile(folder));
  }
}

void FilmDialog::DrawStart(editor::Workspace& workspace, Dialogs& dialogs) {
  Hint(
      Tr("While you film it says what to do next and how much of the place visitors need is there. "
         "It follows corners in the images; what it says is no map, and training may still find "
         "gaps."));
  const editor::ProjectDocument& document = workspace.project().document();
  ChosenPlace place;
  if (BeginProperties("film")) {
    place = PlaceRows(document, dialogs.fields);
    field_.Show(camera_, workspace.project().paths().folder);
    EndProperties();
  }
  field_.DrawHint();
  WarningText(problem_);
  const DialogAnswer answer = DialogButtons(Tr("Film"), PlaceProblem(document, place));
  if (answer == DialogAnswer::kCancel) {
    Close(dialogs);
  }
  if (answer == DialogAnswer::kAct) {
    Begin(workspace, place);
  }
}

void FilmDialog::Train(editor::Workspace& workspace, Dialogs& dialogs) {
  DialogFields fields;
  fields.file = film_->file().string();
  Close(dialogs);
  TrainRecording(workspace, place_, fields);
}

// The buttons during filming.
void FilmDialog::DrawButtons() {
  const DialogProblem problem = film_->moment().frames == 0
                                    ? Missing(Tr("Waiting for the camera\xe2\x80\xa6"))
                                    : DialogProblem();
  switch (DialogButtons(Tr("Stop and train"), problem, Tr("Discard\xe2\x80\xa6"))) {
    case DialogAnswer::kCancel:
      asks_ = true;
      break;
    case DialogAnswer::kAct:
      film_->Finish();
      break;
    case DialogAnswer::kNone:
      break;
  }
}

void FilmDialog::DrawQuestion(Dialogs& dialogs) {
  ImGui::TextWrapped("%s", Text(Tr("%.0f s are filmed. Train from them, or discard them?"),
                                film_->moment().seconds)
                               .c_str());
  const DialogAnswer answer = DialogButtons(Tr("Stop and train"), {}, Tr("Keep filming"));
  const bool discard = DiscardButton();
  if (answer == DialogAnswer::kAct) {
    film_->Finish();
  }
  asks_ = answer == DialogAnswer::kNone;
  if (discard) {
    Discard(dialogs);
  }
}

// Filming ended by itself: the camera failed, the disk is full, or the recording is over.
void FilmDialog::DrawEnded(const editor::Filmed& filmed, Dialogs& dialogs) {
  if (!filmed.stopped.ok()) {
    WarningText(Text(Tr("Filming has stopped: %s"), filmed.stopped.message().c_str()));
  }
  ImGui::TextWrapped("%s", Text(Tr("%.0f s are filmed, and kept in %s."), filmed.last.seconds,
                                film_->file().filename().c_str())
                               .c_str());
  const DialogAnswer answer = DialogButtons(Tr("Train from it"), {}, Tr("Film again"));
  const bool discard = DiscardButton();
  if (answer == DialogAnswer::kAct) {
    film_->Finish();
  }
  if (answer == DialogAnswer::kCancel) {
    film_.reset();
  } else if (discard) {
    Discard(dialogs);
  }
}

// Filming failed, and there is nothing to keep.
void FilmDialog::DrawFailed(const std::string& problem, Dialogs& dialogs) {
  WarningText(problem);
  const DialogAnswer answer = DialogButtons(Tr("Film again"), {});
  if (answer == DialogAnswer::kCancel) {
    Close(dialogs);
  }
  if (answer == DialogAnswer::kAct) {
    film_.reset();
  }
}

void FilmDialog::DrawFilming(editor::Workspace& workspace,
                             PictureTextures& pictures,
                             Dialogs& dialogs) {
  const editor::FilmMoment moment = film_->moment();
  const std::optional<Result<editor::Filmed>> outcome = film_->outcome();
  const float available = ImGui::GetContentRegionAvail().x;
  const float side = std::min(Px(320), 0.45f * available);
  ImVec2 picture(available - side - Px(14), 0.0f);
  picture.y = std::min(0.75f * picture.x, 0.6f * ImGui::GetMainViewport()->WorkSize.y);
  DrawPicture(pictures, moment, picture);
  ImGui::SameLine(0.0f, Px(14));
  ImGui::BeginGroup();
  ImGui::PushItemWidth(side);
  ImGui::BeginChild("coverage", ImVec2(side, picture.y));
  DrawShares(moment.coverage.shares);
  ImGui::Dummy(ImVec2(0, Px(6)));
  DrawDirections(moment);
  ImGui::Dummy(ImVec2(0, Px(6)));
  DimText(Text(Tr("%.0f s, %d images"), moment.seconds, static_cast<int>(moment.frames)));
  ImGui::EndChild();
  ImGui::PopItemWidth();
  ImGui::EndGroup();

  if (outcome && !outcome->ok()) {
    DrawFailed(outcome->message(), dialogs);
  } else if (outcome && film_->finishing()) {
    Train(workspace, dialogs);
  } else if (outcome) {
    DrawEnded(**outcome, dialogs);
  } else if (asks_) {
    DrawQuestion(dialogs);
  } else {
    DrawButtons();
  }
}

void FilmDialog::Leave(editor::Workspace& workspace, Dialogs& dialogs) {
  if (film_ != nullptr && film_->outcome() && film_->outcome()->ok()) {
    workspace.messages().Tell(editor::Message::Level::kInfo,
                              Text(Tr("What was filmed is kept in %s."), film_->file().c_str()));
    Close(dialogs);
  } else if (film_ != nullptr && !film_->outcome() && film_->moment().frames > 0) {
    const bool escape = ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape), false);
    asks_ = !(asks_ && escape);  // Escape in the question means to continue.
  } else if (film_ != nullptr) {
    Discard(dialogs);  // Nothing was filmed yet.
  } else {
    Close(dialogs);
  }
}

void FilmDialog::Show(editor::Workspace& workspace, PictureTextures& pictures, Dialogs& dialogs) {
  if (dialogs.shown != Dialog::kFilm) {
    if (film_ != nullptr && dialogs.shown == Dialog::kNone) {
      dialogs.shown = Dialog::kFilm;  // Returns from another dialog, such as the list of keys.
    }
    return;
  }
  bool open = true;
  const bool filming = film_ != nullptr;
  DrawModal(Label(Tr("Film a place"), filming ? "filming" : "film").c_str(),
            filming ? 1000.0f : 520.0f, open, [&] {
              filming ? DrawFilming(workspace, pictures, dialogs) : DrawStart(workspace, dialogs);
              open = dialogs.shown == Dialog::kFilm && filming == (film_ != nullptr);
            });
  if (!open && dialogs.shown == Dialog::kFilm && filming == (film_ != nullptr)) {
    Leave(workspace, dialogs);
  }
}

}  // namespace lararium::panels
