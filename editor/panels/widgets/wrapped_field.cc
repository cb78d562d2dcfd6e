#include "editor/panels/widgets/wrapped_field.h"

#include <imgui.h>
#include <imgui_internal.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <array>
#include <functional>
#include <string_view>

#include "editor/panels/widgets/wrapped_text.h"

namespace lararium::panels {

namespace {

// The field that had the keyboard last; there is only one interface.
ImGuiID g_typed_into = 0;

float WidthOf(std::string_view text) {
  return ImGui::CalcTextSize(text.data(), text.data() + text.size()).x;
}

int Hash(std::string_view text) {
  return static_cast<int>(std::hash<std::string_view>()(text) & 0x7fffffff);
}

// While the field has the keyboard it keeps its own copy of the text, which this updates.
struct FieldTask {
  const std::string& text;  // The text to show unless the user is typing.
  float width = 0.0f;
  int typed = 0;   // Hash of the content in the last frame; 0 before the first.
  int cursor = 0;  // Position of the cursor in the last frame.
};

int OnField(ImGuiInputTextCallbackData* data) {
  auto& task = *static_cast<FieldTask*>(data->UserData);
  const std::string shown(data->Buf, static_cast<size_t>(data->BufTextLen));
  std::array<size_t, 3> positions = {static_cast<size_t>(data->CursorPos),
                                     static_cast<size_t>(data->SelectionStart),
                                     static_cast<size_t>(data->SelectionEnd)};
  std::string text = UnwrapText(shown, positions);
  if (task.typed == Hash(text) && text != task.text) {  // The text was changed elsewhere.
    text = task.text;
    positions.fill(text.size());
  }
  const std::string wrapped = WrapText(text, task.width, WidthOf);
  if (wrapped != shown) {
    data->DeleteChars(0, data->BufTextLen);
    data->InsertChars(0, wrapped.data(), wrapped.data() + wrapped.size());
    for (size_t& position : positions) {
      position = PositionInWrapped(wrapped, position);
    }
  } else {
    positions = {static_cast<size_t>(data->CursorPos), static_cast<size_t>(data->SelectionStart),
                 static_cast<size_t>(data->SelectionEnd)};
    const bool on = data->CursorPos >= task.cursor;
    for (size_t& position : positions) {
      position = OutOfRowBreak(wrapped, position, on);
    }
  }
  data->CursorPos = static_cast<int>(positions[0]);
  data->SelectionStart = static_cast<int>(positions[1]);
  data->SelectionEnd = static_cast<int>(positions[2]);
  task.cursor = data->CursorPos;
  task.typed = Hash(text);
  return 0;
}

}  // namespace

bool WrappedField(const char* id, std::string& text, int least_rows, int most_rows) {
  const ImGuiStyle& style = ImGui::GetStyle();
  ImGuiStorage& storage = *ImGui::GetStateStorage();
  ImGui::PushID(id);
  const float room = ImGui::CalcItemWidth();
  const float width = room - 2.0f * style.FramePadding.x - style.ScrollbarSize;
  std::string wrapped = WrapText(text, width, WidthOf);
  const auto rows = static_cast<int>(std::count(wrapped.begin(), wrapped.end(), '\n')) + 1;
  const float height =
      static_cast<float>(std::clamp(rows, least_rows, most_rows)) * ImGui::GetTextLineHeight() +
      2.0f * style.FramePadding.y;
  const ImGuiID typed = ImGui::GetID("typed");
  const ImGuiID cursor = ImGui::GetID("cursor");
  FieldTask task{text, width, storage.GetInt(typed), storage.GetInt(cursor)};
  const bool edited = ImGui::InputTextMultiline("##field", &wrapped, ImVec2(room, height),
                                                ImGuiInputTextFlags_NoUndoRedo |
                                                    ImGuiInputTextFlags_NoHorizontalScroll |
                                                    ImGuiInputTextFlags_CallbackAlways,
                                                OnField, &task);
  const bool active = ImGui::GetActiveID() == ImGui::GetID("##field");
  g_typed_into = active ? ImGui::GetActiveID() : g_typed_into;
  storage.SetInt(typed, active ? task.typed : 0);
  storage.SetInt(cursor, task.cursor);
  ImGui::PopID();
  std::string now = edited ? UnwrapText(wrapped) : text;
  if (now == text) {
    return false;
  }
  text = std::move(now);
  return true;
}

bool TypesIntoWrappedField() { return g_typed_into != 0 && ImGui::GetActiveID() == g_typed_into; }

}  // namespace lararium::panels
