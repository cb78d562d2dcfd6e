#include "editor/panels/checks_panel.h"

#include <imgui.h>

#include <cstdlib>
#include <set>
#include <string>
#include <vector>

#include "editor/panels/text.h"
#include "editor/panels/theme.h"
#include "editor/panels/timeline_rows.h"
#include "editor/panels/widgets.h"

namespace lararium::panels {

namespace {

// What the last check of the files found, and what the script as it is now says besides.
std::vector<std::string> Problems(const app::Workspace& workspace) {
  std::vector<std::string> problems;
  std::set<std::string> known;
  const auto add = [&](const std::string& problem) {
    // The same error with and without its time is one.
    const size_t time = problem.rfind(" (at ");
    if (known.insert(problem.substr(0, time)).second) {
      problems.push_back(problem);
    }
  };
  const app::ScriptDocument& script = workspace.script();
  if (!script.problem().ok()) {
    add(script.problem().message());
  } else {
    for (const std::string& problem : script.timeline()->problems()) {
      add(problem);
    }
  }
  for (const std::string& problem : workspace.problems()) {
    add(problem);
  }
  if (workspace.drama_run() != nullptr) {
    for (const std::string& problem : workspace.drama_run()->problems) {
      add(problem);
    }
  }
  return problems;
}

// "... (at 12.34 s)"; below 0: it says no time.
double TimeOf(const std::string& problem) {
  const size_t at = problem.rfind("(at ");
  return at == std::string::npos ? -1.0 : std::strtod(problem.c_str() + at + 4, nullptr);
}

void GoTo(app::Workspace& workspace, EditorState& state, const std::string& problem) {
  const int line = LineOfPlace(problem, workspace.paths().Drama().filename().string());
  const double time = TimeOf(problem);
  if (time >= 0.0) {
    workspace.SetPlaying(false);
    workspace.SetTime(time);
  }
  if (line > 0) {
    state.script_line = line;
    state.bottom = BottomTab::kScript;
    return;
  }
  for (const app::CastDocument& member : workspace.document().cast) {
    if (problem.find("/" + member.name + ".") != std::string::npos) {
      state.selection = {Selection::Kind::kActor, member.name};
    }
  }
  for (const app::ObjectDocument& object : workspace.document().objects) {
    if (problem.find("'" + object.name + "'") != std::string::npos) {
      state.selection = {Selection::Kind::kObject, object.name};
    }
  }
}

}  // namespace

int CountProblems(const app::Workspace& workspace) {
  return static_cast<int>(Problems(workspace).size());
}

void ShowChecksTools(app::Workspace& workspace) {
  const bool busy = workspace.tasks().Running(app::Workspace::kChecking);
  ImGui::BeginDisabled(busy);
  if (ImGui::Button(busy ? Tr("Checking\xe2\x80\xa6") : Tr("Check the saved project"))) {
    workspace.Check();
  }
  ImGui::EndDisabled();
  if (ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) {
    ImGui::SetTooltip("%s", Tr("Looks at every file, and runs the drama in every language "
                               "(lararium-editor check)."));
  }
  if (workspace.commands().dirty()) {
    ImGui::SameLine(0.0f, Px(12));
    DimText(Tr("There are edits that are not saved."));
  }
}

void ShowChecks(app::Workspace& workspace, EditorState& state) {
  const std::vector<std::string> problems = Problems(workspace);
  ImGui::BeginChild("list", ImVec2(0, 0));
  if (problems.empty()) {
    Hint(workspace.checked() ? Tr("Nothing is wrong.")
                             : Tr("Nothing is known to be wrong with the script. A check also "
                                  "looks at files, lines and places."));
  }
  for (size_t i = 0; i < problems.size(); ++i) {
    ImGui::PushID(static_cast<int>(i));
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetContentRegionAvail().x;
    const ImVec2 size = ImGui::CalcTextSize(problems[i].c_str(), nullptr, false, width - Px(24));
    if (ImGui::Selectable("##problem", false, ImGuiSelectableFlags_None,
                          ImVec2(0, size.y + Px(4)))) {
      GoTo(workspace, state, problems[i]);
    }
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    draw.AddCircleFilled(ImVec2(at.x + Px(8), at.y + 0.5f * ImGui::GetTextLineHeight() + Px(2)),
                         Px(4), Packed(Colours().warning));
    draw.AddText(ImGui::GetFont(), ImGui::GetFontSize(), ImVec2(at.x + Px(20), at.y + Px(2)),
                 Packed(Colours().text), problems[i].c_str(), nullptr, width - Px(24));
    ImGui::PopID();
  }
  ImGui::EndChild();
}

}  // namespace lararium::panels
