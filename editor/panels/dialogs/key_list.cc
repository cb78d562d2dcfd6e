#include "editor/panels/dialogs/key_list.h"

#include <imgui.h>

#include <algorithm>
#include <string>

#include "editor/panels/widgets/text.h"
#include "editor/panels/widgets/theme.h"
#include "editor/panels/widgets/widgets.h"

namespace lararium::panels {

namespace {

constexpr float kListWidth = 980.0f;  // logical pixels
constexpr float kKeyWidth = 150.0f;

void DrawRow(const KeyBinding& binding, const std::string& keys) {
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::TextUnformatted(keys.c_str());
  ImGui::TableNextColumn();
  std::string does = Tr(binding.does);
  if (binding.with_shift != nullptr) {
    does += Text(Tr("; with Shift %s"), Tr(binding.with_shift));
  }
  ImGui::PushStyleColor(ImGuiCol_Text, Colours().dim);
  ImGui::TextWrapped("%s", does.c_str());
  ImGui::PopStyleColor();
}

void DrawScope(KeyScope scope) {
  Heading(ScopeTitle(scope));
  if (!ImGui::BeginTable(std::to_string(static_cast<int>(scope)).c_str(), 2)) {
    return;
  }
  ImGui::TableSetupColumn("key", ImGuiTableColumnFlags_WidthFixed, Px(kKeyWidth));
  ImGui::TableSetupColumn("does", ImGuiTableColumnFlags_WidthStretch);
  const std::span<const KeyBinding> bindings = KeyBindings();
  for (size_t i = 0; i < bindings.size(); ++i) {
    if (bindings[i].scope != scope || bindings[i].does == nullptr) {
      continue;
    }
    std::string keys = KeyText(bindings[i]);
    for (size_t other = i + 1; other < bindings.size() && bindings[other].does == nullptr;
         ++other) {
      keys += Text(Tr(" or %s"), KeyText(bindings[other]).c_str());
    }
    DrawRow(bindings[i], keys);
  }
  ImGui::EndTable();
  ImGui::Dummy(ImVec2(0, Px(6)));
}

void DrawColumns() {
  if (!ImGui::BeginTable("columns", 2)) {
    return;
  }
  ImGui::TableNextColumn();
  for (const KeyScope scope : {KeyScope::kAlways, KeyScope::kPanels, KeyScope::kViews,
                               KeyScope::kCamera, KeyScope::kAround}) {
    DrawScope(scope);
  }
  ImGui::TableNextColumn();
  for (const KeyScope scope : {KeyScope::kTimeline, KeyScope::kPicks, KeyScope::kWalk,
                               KeyScope::kLight, KeyScope::kStart}) {
    DrawScope(scope);
  }
  ImGui::EndTable();
}

}  // namespace

bool DrawKeyList(std::span<const KeyPress> keys) {
  const ImVec2 window = ImGui::GetMainViewport()->WorkSize;
  bool open = true;
  const std::string title = Label(Tr("Keys"), "keys");
  const bool was_open = ImGui::IsPopupOpen(title.c_str());
  DrawModal(title.c_str(), std::min(kListWidth, window.x / Px(1.0f) - 32.0f), open, [&] {
    ImGui::BeginChild("keys", ImVec2(0, std::min(Px(720), 0.8f * window.y)));
    DrawColumns();
    ImGui::EndChild();
    Hint(
        Tr("While you type into a field, only keys with Ctrl and F1 to F10 mean this. In the "
           "script and in fields, Ctrl+A, C, X and V choose, copy, cut and paste text."));
  });
  const bool again = std::any_of(keys.begin(), keys.end(), [](const KeyPress& press) {
    return ActionOf(KeyScope::kAlways, press) == KeyAction::kKeyList;
  });
  return open && !(was_open && again);
}

}  // namespace lararium::panels
