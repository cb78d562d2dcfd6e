#include "editor/panels/dialogs/messages.h"

#include <imgui.h>

#include <algorithm>
#include <deque>
#include <string>

#include "editor/panels/widgets/icons.h"
#include "editor/panels/widgets/text.h"
#include "editor/panels/widgets/theme.h"
#include "editor/panels/widgets/widgets.h"
#include "editor/session/task_text.h"

namespace lararium::panels {

namespace {

ImVec4 ColourOf(editor::Message::Level level) {
  switch (level) {
    case editor::Message::Level::kWarning:
      return Colours().warning;
    case editor::Message::Level::kError:
      return Colours().error;
    case editor::Message::Level::kInfo:
      break;
  }
  return Colours().dim;
}

Icon IconOf(editor::Message::Level level) {
  switch (level) {
    case editor::Message::Level::kWarning:
      return Icon::kWarning;
    case editor::Message::Level::kError:
      return Icon::kError;
    case editor::Message::Level::kInfo:
      break;
  }
  return Icon::kInfo;
}

void DrawTask(editor::BackgroundTask& task) {
  const editor::BackgroundTask::State state = task.state();
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(editor::TaskText(task.kind(), state).c_str());
  ImGui::SameLine(0.0f, Px(12));
  const float height = Px(6);
  ImGui::SetCursorPosY(ImGui::GetCursorPosY() + 0.5f * (ImGui::GetFrameHeight() - height));
  ImGui::ProgressBar(static_cast<float>(state.fraction), ImVec2(Px(140), height), "");
  ImGui::SameLine(0.0f, Px(12));
  ImGui::SetCursorPosY(ImGui::GetCursorPosY() - 0.5f * (ImGui::GetFrameHeight() - height));
  ImGui::PushID(&task);
  ImGui::BeginDisabled(state.cancelling);
  if (ImGui::Button(state.cancelling ? Tr("Stopping\xe2\x80\xa6") : Tr("Cancel"))) {
    task.Cancel();
  }
  ImGui::EndDisabled();
  ImGui::PopID();
  ImGui::SameLine(0.0f, Px(20));
}

// The choice between two versions of the project; nothing is saved before it.
void DrawOutsideChoice(editor::Workspace& workspace) {
  const std::string& damage = workspace.project().files().damage();
  ImGui::AlignTextToFramePadding();
  ImGui::TextColored(
      Colours().warning, "%s",
      WithIcon(Icon::kWarning, damage.empty() ? Tr("Changed outside of this window as well:")
                                              : Tr("Changed outside, and cannot be read:"))
          .c_str());
  Tooltip(damage.empty() ? Tr("Nothing is saved until one of the two is chosen.") : damage);
  ImGui::SameLine();
  ImGui::BeginDisabled(!damage.empty());
  if (ImGui::Button(Tr("Take what is in the files"))) {
    workspace.project().AdoptExternal();
  }
  ImGui::EndDisabled();
  Tooltip(damage.empty() ? Tr("An edit like any other: undo brings back what is here.") : damage);
  ImGui::SameLine();
  if (ImGui::Button(Tr("Keep what is here"))) {
    workspace.project().KeepLocal();
  }
  Tooltip(Tr("Saving will then overwrite the files."));
  ImGui::SameLine();
}

}  // namespace

void DrawMessages(const editor::Workspace& workspace) {
  const bool at_end = ImGui::GetScrollY() >= ImGui::GetScrollMaxY() - 1.0f;
  if (workspace.messages().entries().empty()) {
    DimText(Tr("Nothing to report."));
  }
  for (const editor::Message& message : workspace.messages().entries()) {
    ImGui::PushStyleColor(ImGuiCol_Text, ColourOf(message.level));
    ImGui::TextWrapped("%s", WithIcon(IconOf(message.level), message.text).c_str());
    ImGui::PopStyleColor();
  }
  if (at_end) {
    constexpr float kEnd = 1e9f;  // ImGui clamps it to the real end, with the window's border.
    ImGui::SetScrollY(kEnd);
  }
}

void MarkUnread(const editor::Workspace& workspace, uint64_t read) {
  using Level = editor::Message::Level;
  const std::deque<editor::Message>& messages = workspace.messages().entries();
  const auto unread =
      static_cast<size_t>(std::min<uint64_t>(workspace.messages().told() - read, messages.size()));
  Level level = Level::kInfo;
  for (size_t i = messages.size() - unread; i < messages.size(); ++i) {
    level = std::max(level, messages[i].level);
  }
  if (level == Level::kInfo) {
    return;
  }
  const ImVec2 corner(ImGui::GetItemRectMax().x, ImGui::GetItemRectMin().y);
  const std::string sign = WithIcon(IconOf(level), "");
  const ImVec2 size = ImGui::CalcTextSize(sign.c_str());
  ImGui::GetWindowDrawList()->AddText(ImVec2(corner.x - 0.5f * size.x, corner.y - 0.35f * size.y),
                                      ImGui::ColorConvertFloat4ToU32(ColourOf(level)),
                                      sign.c_str());
}

void DrawStatusBar(editor::Workspace& workspace) {
  for (const editor::TaskList::Entry& entry : workspace.tasks().entries()) {
    DrawTask(*entry.task);
  }
  if (workspace.project().files().changed_outside()) {
    DrawOutsideChoice(workspace);
  }
  const size_t unbuilt = workspace.cast().pictures().PeopleLeft();
  if (unbuilt > 0) {
    ImGui::AlignTextToFramePadding();
    const char* text = workspace.preview().has_stand_ins()
                           ? Tr("Building people: %d left; others stand in")
                           : Tr("Building people: %d left");
    DimText(Text(text, static_cast<int>(unbuilt)));
    ImGui::SameLine();
  }
  // The newest message, in every layout; while tasks run, only warnings and errors.
  const bool tells = !workspace.messages().entries().empty() &&
                     !workspace.project().files().changed_outside() &&
                     (workspace.tasks().entries().empty() ||
                      workspace.messages().entries().back().level != editor::Message::Level::kInfo);
  if (tells) {
    const editor::Message& newest = workspace.messages().entries().back();
    ImGui::AlignTextToFramePadding();
    const float room = 0.62f * ImGui::GetContentRegionAvail().x;
    const std::string shown = Elided(WithIcon(IconOf(newest.level), newest.text), room);
    ImGui::TextColored(ColourOf(newest.level), "%s", shown.c_str());
    Tooltip(newest.text);
    ImGui::SameLine();
  }
  std::string text = workspace.project().paths().folder.string();
  if (workspace.project().commands().dirty()) {
    text += std::string("  \xe2\x80\xa2  ") + Tr("not saved");
  }
  const float width = ImGui::CalcTextSize(text.c_str()).x;
  const float right = ImGui::GetContentRegionMax().x - width;
  if (workspace.tasks().entries().empty() && workspace.messages().entries().empty() &&
      unbuilt == 0) {
    ImGui::AlignTextToFramePadding();
    DimText(Tr("Ready"));
    ImGui::SameLine();
  }
  if (right > ImGui::GetCursorPosX()) {
    ImGui::SetCursorPosX(right);
    ImGui::AlignTextToFramePadding();
    DimText(text);
  }
}

}  // namespace lararium::panels
