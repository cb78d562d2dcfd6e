#include "editor/panels/dialogs/export_panel.h"

#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <string>

#include "editor/panels/dialogs/checks_panel.h"
#include "editor/panels/widgets/text.h"
#include "editor/panels/widgets/theme.h"
#include "editor/panels/widgets/widgets.h"
#include "editor/session/task_text.h"
#include "shared/bundle/signature.h"
#include "shared/core/file.h"

namespace lararium::panels {

namespace {

constexpr int kFewestPoints = 500;
constexpr int kMostPoints = 200'000;
constexpr std::array<const char*, editor::kContentKinds> kKindNames = {
    TrLater("Places"),       TrLater("People"), TrLater("Objects"),
    TrLater("Lines spoken"), TrLater("Sounds"), TrLater("Drama, captions")};

std::string Megabytes(uint64_t bytes) { return Text("%.1f MB", static_cast<double>(bytes) / 1e6); }

void DrawContentsTable(const editor::BundleSummary& contents, bool written) {
  if (!ImGui::BeginTable("contents", 3, ImGuiTableFlags_BordersInnerH)) {
    return;
  }
  ImGui::TableSetupColumn("what", ImGuiTableColumnFlags_WidthStretch);
  ImGui::TableSetupColumn("count", ImGuiTableColumnFlags_WidthFixed, Px(60));
  ImGui::TableSetupColumn("size", ImGuiTableColumnFlags_WidthFixed, Px(110));
  for (size_t i = 0; i < editor::kContentKinds; ++i) {
    const editor::ContentRow& row = contents.rows[i];
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(Tr(kKindNames[i]));
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(Text("%d", row.count).c_str());
    ImGui::TableNextColumn();
    if (row.count > 0) {
      const bool known = row.unbaked == 0 || row.bytes > 0;
      DimText(known ? Megabytes(row.bytes) : std::string(Tr("not baked yet")));
    }
  }
  ImGui::TableNextColumn();
  ImGui::TextUnformatted(written ? Tr("The show") : Tr("The show, about"));
  ImGui::TableNextColumn();
  ImGui::TableNextColumn();
  ImGui::TextUnformatted(Megabytes(contents.bytes()).c_str());
  ImGui::EndTable();
}

void DrawExportWarnings(editor::Workspace& workspace, Dialogs& dialogs, EditorActions& actions) {
  if (const int unbaked = dialogs.fields.contents->unbaked(); unbaked > 0) {
    DimText(TrCount("%d thing is baked first; that takes a while.",
                    "%d things are baked first; that takes a while.", unbaked));
  }
  const int problems = CountProblems(workspace);
  ImGui::AlignTextToFramePadding();
  if (problems > 0) {
    ImGui::TextColored(Colours().warning, "%s",
                       TrCount("%d problem is known.", "%d problems are known.", problems).c_str());
  } else {
    DimText(workspace.jobs().checked() ? Tr("The last check found no problem.")
                                       : Tr("The project was not checked yet."));
  }
  ImGui::SameLine();
  if (ImGui::Button(problems > 0 ? Tr("Look at them") : Tr("Check"))) {
    if (problems == 0) {
      workspace.jobs().Check();
    }
    actions.push_back(OpenTab{BottomTab::kChecks});
    dialogs.shown = Dialog::kNone;
  }
}

// Makes a pair of keys beside the project: NAME.key, to be kept secret, and NAME.pub for the
// players.
void MakeKeys(editor::Workspace& workspace, DialogFields& fields) {
  const std::filesystem::path folder = workspace.project().paths().folder;
  const std::filesystem::path stem = folder.parent_path() / folder.stem();
  const bundle::SecretKey key = bundle::MakeSecretKey();
  Status made = bundle::SaveSecretKey(stem.string() + ".key", key);
  if (made.ok()) {
    made = bundle::SavePublicKey(stem.string() + ".pub", key.public_key());
  }
  if (!made.ok()) {
    workspace.messages().Tell(editor::Message::Level::kError, made.message());
    return;
  }
  fields.key = stem.string() + ".key";
  workspace.messages().Tell(editor::Message::Level::kInfo,
                            Text(Tr("Keep %s to yourself, give %s to the players."),
                                 fields.key.c_str(), (stem.string() + ".pub").c_str()));
}

void DrawFields(editor::Workspace& workspace, DialogFields& fields) {
  if (!BeginProperties("export", 120.0f)) {
    return;
  }
  PropertyLabel(Tr("File"));
  PathField("file", fields.file, workspace.project().paths().folder, FileType::kShow);
  PropertyLabel(Tr("Points of a map"));
  if (ImGui::InputInt("##points", &fields.points, 1000, 5000)) {
    fields.points = std::clamp(fields.points, kFewestPoints, kMostPoints);
    fields.contents.reset();
  }
  PropertyLabel(Tr("Signed with"));
  const ImGuiStyle& style = ImGui::GetStyle();
  const float button = ImGui::CalcTextSize(Tr("New keys")).x + 2 * style.FramePadding.x;
  PathField("key", fields.key, workspace.project().paths().folder, FileType::kKey,
            button + style.ItemSpacing.x);
  ImGui::SameLine();
  if (ImGui::Button(Tr("New keys"))) {
    MakeKeys(workspace, fields);
  }
  Tooltip(
      Tr("Players that are given the public key refuse what was not signed\n"
         "with the secret one, or was altered since."));
  EndProperties();
}

DialogProblem ExportProblem(const editor::Workspace& workspace, const DialogFields& fields) {
  if (workspace.project().document().places.empty()) {
    return Missing(Tr("A show needs a place: train one first."));
  }
  if (!fields.file.ends_with(".larshow")) {
    return Wrong(Tr("The name ends in .larshow."));
  }
  const bool has_key =
      fields.key.empty() || FileExists(workspace.project().paths().Resolve(fields.key));
  return has_key ? DialogProblem() : Wrong(Tr("Choose a key that exists, or none."));
}

void DrawBefore(editor::Workspace& workspace, Dialogs& dialogs, EditorActions& actions) {
  DialogFields& fields = dialogs.fields;
  Hint(
      Tr("Packs what visitors need into one file. The project is saved and what is stale is "
         "baked first."));
  DrawFields(workspace, fields);
  if (!fields.contents) {
    fields.contents = editor::ForecastShow(
        workspace.project().paths(), workspace.project().document(), {.max_points = fields.points});
  }
  Heading(Tr("What goes in"));
  DrawContentsTable(*fields.contents, false);
  DrawExportWarnings(workspace, dialogs, actions);
  if (fields.exporting && !workspace.jobs().export_problem().empty()) {
    ImGui::PushStyleColor(ImGuiCol_Text, Colours().error);
    ImGui::TextWrapped("%s", workspace.jobs().export_problem().c_str());
    ImGui::PopStyleColor();
  }
  const DialogAnswer answer = DialogButtons(Tr("Export"), ExportProblem(workspace, fields));
  if (answer == DialogAnswer::kCancel) {
    dialogs.shown = Dialog::kNone;
  }
  if (answer == DialogAnswer::kAct) {
    editor::ExportRequest request{.out = workspace.project().paths().Resolve(fields.file)};
    request.budget.max_points = fields.points;
    if (!fields.key.empty()) {
      request.key = workspace.project().paths().Resolve(fields.key);
    }
    workspace.jobs().Export(request);
    fields.exporting = true;
  }
}

void DrawDuring(editor::BackgroundTask& task, Dialogs& dialogs) {
  const editor::BackgroundTask::State now = task.state();
  Hint(Tr("The window can be used meanwhile: the export goes on when this is closed."));
  ImGui::Dummy(ImVec2(0, Px(6)));
  const std::string text =
      now.cancelling ? Tr("Stopping\xe2\x80\xa6") : editor::TaskText(task.kind(), now);
  ImGui::TextUnformatted(text.c_str());
  ImGui::ProgressBar(static_cast<float>(now.fraction), ImVec2(-FLT_MIN, Px(8)), "");
  switch (DialogButtons(Tr("Close"), {}, Tr("Stop"))) {
    case DialogAnswer::kAct:
      dialogs.shown = Dialog::kNone;
      break;
    case DialogAnswer::kCancel:
      task.Cancel();
      break;
    case DialogAnswer::kNone:
      break;
  }
}

void DrawAfter(editor::Workspace& workspace, Dialogs& dialogs) {
  const editor::JobRunner::ExportedShow& shown = *workspace.jobs().exported();
  Hint(Text(Tr("Wrote %s."), shown.file.c_str()));
  Heading(Tr("What went in"));
  DrawContentsTable(shown.contents, true);
  DimText(shown.contents.is_signed ? Tr("Signed.")
                                   : Tr("Not signed: players that ask for a signature refuse it."));
  DimText(Tr("The player is left with Escape."));
  const bool playing = workspace.tasks().Running(editor::TaskKind::kTrying);
  switch (DialogButtons(playing ? Tr("Stop player") : Tr("Test in player"), {}, Tr("Close"))) {
    case DialogAnswer::kAct:
      if (playing) {
        workspace.tasks().Cancel(editor::TaskKind::kTrying);
      } else {
        workspace.jobs().TryShow();
      }
      break;
    case DialogAnswer::kCancel:
      dialogs.shown = Dialog::kNone;
      break;
    case DialogAnswer::kNone:
      break;
  }
}

}  // namespace

void ExportDialog(editor::Workspace& workspace, Dialogs& dialogs, EditorActions& actions) {
  DialogFields& fields = dialogs.fields;
  if (fields.file.empty()) {
    const std::filesystem::path folder = workspace.project().paths().folder;
    fields.file = (folder.parent_path() / folder.stem()).string() + ".larshow";
  }
  if (editor::BackgroundTask* task = workspace.tasks().Find(editor::TaskKind::kExporting)) {
    fields.exporting = true;
    DrawDuring(*task, dialogs);
  } else if (fields.exporting && workspace.jobs().export_problem().empty() &&
             workspace.jobs().exported() != nullptr) {
    DrawAfter(workspace, dialogs);
  } else {
    DrawBefore(workspace, dialogs, actions);
  }
}

}  // namespace lararium::panels
