#include "editor/panels/dialogs/training_report_panel.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>

#include "editor/jobs/background_task.h"
#include "editor/panels/widgets/text.h"
#include "editor/panels/widgets/theme.h"
#include "editor/panels/widgets/widgets.h"

namespace lararium::panels {

namespace {

void DrawFigures(const editor::TrainingReport& report) {
  if (!BeginProperties("report", 120.0f)) {
    return;
  }
  const float share = report.frames > 0
                          ? static_cast<float>(report.located) / static_cast<float>(report.frames)
                          : 0.0f;
  PropertyLabel(Tr("Images located"));
  ImGui::PushStyleColor(ImGuiCol_PlotHistogram, Colours().chosen);
  ImGui::ProgressBar(share, ImVec2(-FLT_MIN, 0),
                     Text(Tr("%d of %d"), report.located, report.frames).c_str());
  ImGui::PopStyleColor();
  PropertyText(Tr("Points"), std::to_string(report.points));
  PropertyText(Tr("Error"), Text(Tr("%.2f px on average, 95 %% within %.2f px"),
                                 report.mean_error_px, report.error_95_px));
  PropertyText(Tr("Took"), editor::FormatDuration(report.seconds));
  PropertyText(Tr("Recording"), std::filesystem::path(report.recording).filename().string());
  PropertyText(Tr("Trained"), DateText(report.ended));
  EndProperties();
}

// Shows the most urgent advice; the page of `train --report` has all of it.
void DrawAdvice(const editor::TrainingReport& report) {
  constexpr size_t kMost = 5;
  Heading(Tr("What to film next"));
  const size_t shown = std::min(kMost, report.advice.size());
  for (size_t i = 0; i < shown; ++i) {
    ImGui::Bullet();
    ImGui::SameLine(0.0f, Px(14));
    ImGui::PushTextWrapPos(0.0f);
    ImGui::TextUnformatted(train::AdviceSentence(report.advice[i]).Translated(Tr).c_str());
    ImGui::PopTextWrapPos();
  }
  if (shown < report.advice.size()) {
    Hint(Text(Tr("and %zu more"), report.advice.size() - shown));
  }
}

// Returns true when the dialog is finished.
bool DrawEnd(editor::Workspace& workspace) {
  if (!workspace.map().loaded().has_previous) {
    ImGui::Dummy(ImVec2(0, Px(6)));
    const float width = WidestButton(std::array{Tr("Close")}, 110.0f);
    ImGui::SetCursorPosX(ImGui::GetContentRegionMax().x - width);
    return ImGui::Button(Tr("Close"), ImVec2(width, 0));
  }
  Hint(
      Tr("The map from before stays beside the new one until the next training, and can be put "
         "back here or in the place's inspector."));
  const DialogAnswer answer = DialogButtons(Tr("Keep this map"), {}, Tr("Put the former map back"));
  if (answer == DialogAnswer::kCancel) {
    workspace.training().RestorePreviousMap();
  }
  return answer != DialogAnswer::kNone;
}

}  // namespace

void TrainingReportDialog(editor::Workspace& workspace, Dialogs& dialogs) {
  const std::shared_ptr<const editor::TrainingReport> report = workspace.map().loaded().report;
  if (report == nullptr || workspace.project().place() == nullptr) {
    dialogs.shown = Dialog::kNone;
    return;
  }
  Heading(workspace.project().place()->label().c_str());
  DrawFigures(*report);
  ImGui::Dummy(ImVec2(0, Px(4)));
  DrawAdvice(*report);
  if (DrawEnd(workspace)) {
    dialogs.shown = Dialog::kNone;
  }
}

}  // namespace lararium::panels
