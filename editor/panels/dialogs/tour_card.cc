#include "editor/panels/dialogs/tour_card.h"

#include <imgui.h>

#include <algorithm>
#include <string>

#include "editor/panels/widgets/text.h"
#include "editor/panels/widgets/theme.h"
#include "editor/panels/widgets/widgets.h"

namespace lararium::panels {

namespace {

constexpr float kCardWidth = 380.0f;  // logical pixels

void DrawProgress(const Tour& tour) {
  const float shown = static_cast<float>(tour.number() + (tour.finished() ? 1 : 0));
  const float all = static_cast<float>(TourSteps().size());
  ImGui::ProgressBar(shown / all, ImVec2(-FLT_MIN, Px(5)), "");
}

void DrawStep(const TourStep& step) {
  Heading(Tr(step.title));
  std::string text = Tr(step.text);
  if (step.key != KeyAction::kNone) {
    text += Text(Tr(" Key: %s."), KeyText(step.key).c_str());
  }
  ImGui::TextWrapped("%s", text.c_str());
}

}  // namespace

TourFacts FactsOf(const editor::Workspace& workspace,
                  const Selection& selection,
                  const ViewOptions& options,
                  const Dialogs& dialogs) {
  TourFacts facts;
  facts.trained = workspace.map().loaded().database != nullptr;
  facts.picture = workspace.preview().picture() != nullptr;
  facts.playing = workspace.playback().playing();
  facts.report = dialogs.shown == Dialog::kTrainingReport;
  facts.around = options.view == ViewKind::kAround;
  facts.matches = options.show_matches;
  facts.person = selection.kind == Selection::Kind::kActor;
  facts.script = workspace.project().script().revision();
  facts.can_redo = workspace.project().commands().CanRedo();
  facts.checked = workspace.jobs().checked();
  facts.dirty = workspace.project().commands().dirty();
  facts.exported = workspace.jobs().exported() != nullptr;
  if (const editor::PlaceDocument* place = workspace.project().place()) {
    const geometry::Similarity3& stage = place->picked_from_stage;
    facts.stage = Text("%g %g %g %g %g %g %g %g", stage.scale, stage.translation.x(),
                       stage.translation.y(), stage.translation.z(), stage.rotation.w(),
                       stage.rotation.x(), stage.rotation.y(), stage.rotation.z());
    for (const editor::ProbeDocument& probe : place->probes) {
      const Eigen::Quaterniond& q = probe.stage_from_probe;
      facts.light += Text("%g %g %g %g ", q.w(), q.x(), q.y(), q.z());
    }
  }
  return facts;
}

void DrawTourCard(const editor::Workspace& workspace,
                  const Selection& selection,
                  const ViewOptions& options,
                  const Dialogs& dialogs,
                  Input& input,
                  Tour& tour) {
  if (tour.step() == nullptr) {
    return;
  }
  const TourFacts facts = FactsOf(workspace, selection, options, dialogs);
  tour.Update(facts);
  // Placed over the end of the timeline's tracks, where it hides neither picture nor map nor the
  // beginnings of lists. The user can move it.
  const ImGuiViewport& window = *ImGui::GetMainViewport();
  const float x = std::max(window.WorkSize.x - Px(744), 0.0f);
  const float y = window.WorkSize.y - Px(52);
  ImGui::SetNextWindowPos(ImVec2(window.WorkPos.x + x, window.WorkPos.y + y), ImGuiCond_Appearing,
                          ImVec2(0.0f, 1.0f));
  ImGui::SetNextWindowSize(ImVec2(Px(kCardWidth), 0));
  const std::string title = Label(Tr("Tour"), "tour");
  bool open = true;
  input.keyboard.Before(Region::kTour);
  ImGui::PushStyleColor(ImGuiCol_WindowBg, Colours().panel);
  ImGui::PushStyleColor(ImGuiCol_Border, Colours().accent);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, Px(6));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, Px(1));
  if (ImGui::Begin(title.c_str(), &open,
                   ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoCollapse |
                       ImGuiWindowFlags_NoSavedSettings)) {
    input.keyboard.Begin(Region::kTour);
    DrawProgress(tour);
    if (tour.finished()) {
      ImGui::TextWrapped("%s", Tr("That was the tour. Film a place of your own and begin with New "
                                  "from video on the start page."));
      open &= !ImGui::Button(Tr("Close"));
    } else {
      DrawStep(*tour.step());
      ImGui::Dummy(ImVec2(0, Px(2)));
      if (ImGui::Button(Tr("Skip"))) {
        tour.Skip(facts);
      }
      ImGui::SameLine();
      open &= !ImGui::Button(Tr("End the tour"));
    }
    input.keyboard.End(Region::kTour);
  }
  ImGui::End();
  ImGui::PopStyleVar(2);
  ImGui::PopStyleColor(2);
  if (!open) {
    tour.End();
  }
}

}  // namespace lararium::panels
