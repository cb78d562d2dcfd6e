#include "editor/panels/timeline/script_panel.h"

#include <imgui.h>
#include <imgui_internal.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "editor/panels/timeline/timeline_rows.h"
#include "editor/panels/widgets/text.h"
#include "editor/panels/widgets/theme.h"
#include "editor/panels/widgets/widgets.h"

namespace lararium::panels {

// The position and the scrolling of the text field, screen pixels.
struct FieldView {
  ImVec2 at;    // Top left of the line numbers and the text.
  ImVec2 text;  // Top left of the first character, after scrolling.
  ImVec2 size;
  float gutter = 0.0f;
  float line = 0.0f;  // Height of a line.
  size_t first = 0;   // First visible line.
  size_t last = 0;    // Behind the last visible line.
};

namespace {

constexpr double kTypingPause = 1.0;  // Seconds; after a longer pause, typing is a new command.

ImVec4 ColourOf(LuaPart part) {
  switch (part) {
    case LuaPart::kKeyword:
      return Colours().keyword;
    case LuaPart::kText:
      return Colours().string;
    case LuaPart::kNumber:
      return Colours().number;
    case LuaPart::kComment:
      return Colours().dim;
    case LuaPart::kCall:
      return Colours().call;
    case LuaPart::kBad:
      return Colours().error;
    case LuaPart::kPlain:
      break;
  }
  return Colours().text;
}

// Changes for the field while it has the keyboard, because it then keeps its own copy of the text.
struct ScriptFieldTask {
  int64_t go_to = -1;
  bool change = false;
  drama::TextEdit edit;
  size_t cursor = 0;
};

int OnScriptField(ImGuiInputTextCallbackData* data) {
  auto& task = *static_cast<ScriptFieldTask*>(data->UserData);
  if (std::exchange(task.change, false)) {
    data->DeleteChars(static_cast<int>(task.edit.offset),
                      static_cast<int>(task.edit.removed.size()));
    data->InsertChars(static_cast<int>(task.edit.offset), task.edit.inserted.data(),
                      task.edit.inserted.data() + task.edit.inserted.size());
  }
  if (task.go_to >= 0) {
    data->CursorPos = static_cast<int>(std::min<int64_t>(task.go_to, data->BufTextLen));
    data->SelectionStart = data->SelectionEnd = data->CursorPos;
    task.go_to = -1;
  }
  task.cursor = static_cast<size_t>(data->CursorPos);
  return 0;
}

}  // namespace

size_t ScriptPanel::LineAt(size_t offset) const {
  return static_cast<size_t>(std::upper_bound(lines_.begin(), lines_.end(), offset) -
                             lines_.begin()) -
         1;
}

void ScriptPanel::EndTyping(editor::Workspace& workspace) {
  if (std::exchange(typing_, false)) {
    workspace.project().EndGesture();
  }
}

void ScriptPanel::CollectProblems(const editor::Workspace& workspace) {
  const editor::ScriptDocument& script = workspace.project().script();
  const int64_t of = script.revision() * 1000003 + workspace.dry_run().number();
  const size_t found = workspace.jobs().problems().size() + workspace.jobs().warnings().size();
  if (of == problems_of_ && problem_count_ == found) {
    return;
  }
  problems_of_ = of;
  problem_count_ = found;
  problems_.clear();
  const std::string file = workspace.project().paths().Drama().filename().string();
  const auto add = [&](const Sentence& problem) {
    const std::string message = problem.English();
    const int line = LineOfPlace(message, file);
    if (line > 0) {
      std::vector<Sentence>& at = problems_[line];
      const bool told = std::any_of(at.begin(), at.end(), [&](const Sentence& other) {
        return other.English().find(message) != std::string::npos;
      });
      if (!told) {
        at.push_back(problem);
      }
    }
  };
  if (!script.problem().ok()) {
    add(script.problem().message());
  } else {
    for (const std::string& problem : script.timeline()->problems()) {
      add(problem);
    }
  }
  if (workspace.dry_run().newest() != nullptr) {
    for (const std::string& problem : workspace.dry_run().newest()->problems) {
      add(problem);
    }
  }
  for (const auto* problems : {&workspace.jobs().problems(), &workspace.jobs().warnings()}) {
    std::for_each(problems->begin(), problems->end(), add);
  }
}

void ScriptPanel::DrawText(const FieldView& view) {
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const auto begin = buffer_.data();
  auto word =
      std::lower_bound(words_.begin(), words_.end(), lines_[view.first],
                       [](const ColouredWord& w, size_t offset) { return w.end <= offset; });
  for (size_t i = view.first; i < view.last; ++i) {
    const size_t line_begin = lines_[i];
    const size_t line_end = i + 1 < lines_.size() ? lines_[i + 1] - 1 : buffer_.size();
    const float y = view.text.y + view.line * static_cast<float>(i);
    float x = view.text.x;
    if (problems_.contains(static_cast<int>(i) + 1)) {
      draw.AddRectFilled(ImVec2(view.at.x + view.gutter, y),
                         ImVec2(view.at.x + view.size.x, y + view.line),
                         Packed(Colours().error, kErrorTint));
    }
    size_t at = line_begin;
    const auto write = [&](size_t to, const ImVec4& colour) {
      if (to > at) {
        draw.AddText(ImVec2(x, y), Packed(colour), begin + at, begin + to);
        x += ImGui::CalcTextSize(begin + at, begin + to).x;
        at = to;
      }
    };
    while (word != words_.end() && word->begin < line_end) {
      write(std::max<size_t>(word->begin, at), Colours().text);
      write(std::min<size_t>(word->end, line_end), ColourOf(word->part));
      if (word->end > line_end) {
        break;  // The word continues in the next line.
      }
      ++word;
    }
    write(line_end, Colours().text);
  }
}

void ScriptPanel::DrawGutter(const FieldView& view) {
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const size_t current = LineAt(std::min(cursor_, buffer_.size()));
  for (size_t i = view.first; i < view.last; ++i) {
    const float y = view.text.y + view.line * static_cast<float>(i);
    const std::string number = std::to_string(i + 1);
    const float width = ImGui::CalcTextSize(number.c_str()).x;
    const auto problem = problems_.find(static_cast<int>(i) + 1);
    const bool wrong = problem != problems_.end();
    draw.AddText(ImVec2(view.at.x + view.gutter - Px(14) - width, y),
                 Packed(wrong          ? Colours().error
                        : i == current ? Colours().text
                                       : Colours().dim,
                        wrong || i == current ? 1.0f : 0.7f),
                 number.c_str());
    if (wrong) {
      draw.AddCircleFilled(ImVec2(view.at.x + Px(8), y + 0.5f * view.line), Px(4),
                           Packed(Colours().error));
      if (ImGui::IsMouseHoveringRect(ImVec2(view.at.x, y),
                                     ImVec2(view.at.x + view.gutter, y + view.line))) {
        ImGui::BeginTooltip();
        ImGui::PushTextWrapPos(Px(560));
        for (const Sentence& sentence : problem->second) {
          ImGui::TextUnformatted(sentence.Translated(Tr).c_str());
        }
        ImGui::PopTextWrapPos();
        ImGui::EndTooltip();
      }
    }
  }
}

void ScriptPanel::Refresh(editor::Workspace& workspace) {
  if (workspace.project().script().revision() != revision_) {
    outside_ = drama::Difference(buffer_, workspace.project().script().text());
    revision_ = workspace.project().script().revision();
    buffer_ = workspace.project().script().text();
    lines_ = LineStarts(buffer_);
    words_ = ColourLua(buffer_);
  }
}

void ScriptPanel::DrawField(editor::Workspace& workspace, Input& input) {
  ScriptFieldTask task;
  task.go_to = std::exchange(go_to_, -1);
  Refresh(workspace);
  if (outside_) {
    // An active field keeps its own copy of the text.
    task.change = true;
    task.edit = *std::exchange(outside_, std::nullopt);
    EndTyping(workspace);
  }
  FieldView view;
  view.at = ImGui::GetCursorScreenPos();
  view.size = ImGui::GetContentRegionAvail();
  view.line = ImGui::GetTextLineHeight();
  const std::string widest = std::to_string(std::max<size_t>(lines_.size(), 999));
  view.gutter = ImGui::CalcTextSize(widest.c_str()).x + Px(34);
  ImGui::SetCursorScreenPos(ImVec2(view.at.x + view.gutter, view.at.y));
  ImGui::PushStyleColor(ImGuiCol_FrameBg, ImVec4(0, 0, 0, 0));
  // The text is drawn below, in colours.
  ImGui::PushStyleColor(ImGuiCol_Text, ImVec4(0, 0, 0, 0));
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, ImVec2(0, 0));
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(0, 0));
  const ImGuiID id = ImGui::GetID("##script");
  if (std::exchange(focus_field_, false)) {
    ImGui::SetKeyboardFocusHere();
  }
  const bool edited = ImGui::InputTextMultiline(
      "##script", &buffer_, ImVec2(view.size.x - view.gutter, view.size.y),
      ImGuiInputTextFlags_AllowTabInput | ImGuiInputTextFlags_NoUndoRedo |
          ImGuiInputTextFlags_CallbackAlways,
      OnScriptField, &task);
  const bool active = ImGui::IsItemActive();
  ImGui::PopStyleVar(2);
  ImGui::PopStyleColor(2);
  if (task.go_to >= 0) {
    go_to_ = task.go_to;  // The field does not have the keyboard yet.
    focus_field_ = true;
  }
  if (active) {
    input.focus = Focus::kScript;
    cursor_ = task.cursor;
  }
  if (edited && buffer_ != workspace.project().script().text()) {
    const size_t line = LineAt(std::min(cursor_, buffer_.size()));
    if (line != typed_line_) {
      EndTyping(workspace);
    }
    typed_line_ = line;
    typing_ = true;
    since_typed_ = 0.0;
    workspace.project().EditScript(Sentence("typing"), buffer_, "typing");
    revision_ = workspace.project().script().revision();
    lines_ = LineStarts(buffer_);
    words_ = ColourLua(buffer_);
  }
  // The field scrolls in its own window.
  char name[256];
  std::snprintf(name, sizeof(name), "%s/##script_%08X", ImGui::GetCurrentWindow()->Name, id);
  ImVec2 scroll(0, 0);
  if (const ImGuiWindow* window = ImGui::FindWindowByName(name)) {
    scroll = window->Scroll;
  }
  const ImGuiInputTextState* field = ImGui::GetInputTextState(id);
  if (field != nullptr && active) {
    scroll.x = field->ScrollX;
  }
  view.text = ImVec2(view.at.x + view.gutter - scroll.x, view.at.y - scroll.y);
  view.first =
      std::min(static_cast<size_t>(std::max(scroll.y / view.line, 0.0f)), lines_.size() - 1);
  view.last =
      std::min(view.first + static_cast<size_t>(view.size.y / view.line) + 2, lines_.size());
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw.PushClipRect(ImVec2(view.at.x + view.gutter, view.at.y),
                    ImVec2(view.at.x + view.size.x, view.at.y + view.size.y), true);
  DrawText(view);
  if (active && field != nullptr &&
      (field->CursorAnim <= 0.0f || std::fmod(field->CursorAnim, 1.2f) <= 0.8f)) {
    const size_t line = LineAt(std::min(cursor_, buffer_.size()));
    const float x = view.text.x +
                    ImGui::CalcTextSize(buffer_.data() + lines_[line], buffer_.data() + cursor_).x;
    const float y = view.text.y + view.line * static_cast<float>(line);
    draw.AddLine(ImVec2(x, y), ImVec2(x, y + view.line), Packed(Colours().text), Px(1.5f));
  }
  draw.PopClipRect();
  draw.PushClipRect(view.at, ImVec2(view.at.x + view.gutter, view.at.y + view.size.y), true);
  DrawGutter(view);
  draw.PopClipRect();
}

void ScriptPanel::DrawTools(editor::Workspace& workspace) {
  Refresh(workspace);
  ImGui::AlignTextToFramePadding();
  const size_t offset = std::min(cursor_, buffer_.size());
  const size_t line = LineAt(offset);
  DimText(Text(Tr("Line %zu, column %zu"), line + 1, offset - lines_[line] + 1));
  CollectProblems(workspace);
  if (!problems_.empty()) {
    ImGui::SameLine(0.0f, Px(16));
    if (ImGui::Button(TrCount("%d line with a problem", "%d lines with problems",
                              static_cast<int>(problems_.size()))
                          .c_str())) {
      // The next problem behind the cursor, or the first one.
      auto next = problems_.upper_bound(static_cast<int>(line) + 1);
      next = next == problems_.end() ? problems_.begin() : next;
      asked_line_ = next->first;
    }
  }
}

void ScriptPanel::Show(editor::Workspace& workspace, Input& input) {
  CollectProblems(workspace);
  focus_field_ |= input.keyboard.TakesOver(Region::kBottom);
  if (asked_line_ > 0) {
    Refresh(workspace);
    const auto line = std::min(static_cast<size_t>(asked_line_), lines_.size());
    go_to_ = static_cast<int64_t>(lines_[line - 1]);
    focus_field_ = true;
    asked_line_ = 0;
    EndTyping(workspace);
  }
  since_typed_ += ImGui::GetIO().DeltaTime;
  if (since_typed_ > kTypingPause) {
    EndTyping(workspace);
  }
  ImGui::PushFont(ThemeFonts().code);
  ImGui::BeginChild("script", ImGui::GetContentRegionAvail(), false,
                    ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse);
  DrawField(workspace, input);
  ImGui::EndChild();
  ImGui::PopFont();
}

}  // namespace lararium::panels
