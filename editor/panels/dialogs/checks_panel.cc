#include "editor/panels/dialogs/checks_panel.h"

#include <imgui.h>

#include <array>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "editor/panels/dialogs/problem_place.h"
#include "editor/panels/widgets/icons.h"
#include "editor/panels/widgets/text.h"
#include "editor/panels/widgets/theme.h"
#include "editor/panels/widgets/widgets.h"

namespace lararium::panels {

namespace {

struct Problem {
  Sentence text;
  bool warning = false;  // The finding may be intended.
};

// The results of the last check of the files, and problems of the present script, errors first.
std::vector<Problem> Problems(const editor::Workspace& workspace) {
  std::vector<Problem> problems;
  std::set<std::string> known;
  const auto add = [&](const auto& texts, bool warning) {
    for (const auto& text : texts) {
      const Sentence sentence = text;
      // The same error with and without a time counts once.
      const std::string english = sentence.English();
      if (known.insert(english.substr(0, english.rfind(" (at "))).second) {
        problems.push_back({sentence, warning});
      }
    }
  };
  const editor::ScriptDocument& script = workspace.project().script();
  if (!script.problem().ok()) {
    add(std::array{script.problem().message()}, false);
  }
  add(workspace.jobs().problems(), false);
  if (workspace.dry_run().newest() != nullptr) {
    add(workspace.dry_run().newest()->problems, false);
  }
  if (script.timeline() != nullptr) {
    add(script.timeline()->problems(), true);
  }
  add(workspace.jobs().warnings(), true);
  return problems;
}

// The object that the text names first: a person, an object, an occluder, a probe or a place.
std::optional<Selection> NamedThing(const editor::Workspace& workspace,
                                    const std::string& problem) {
  std::optional<Selection> named;
  size_t first = std::string::npos;
  const auto offer = [&](Selection::Kind kind, const auto& entries) {
    for (const auto& entry : entries) {
      if (const size_t at = FindName(problem, entry.name); at < first) {
        first = at;
        named = Selection{kind, entry.name};
      }
    }
  };
  offer(Selection::Kind::kActor, workspace.project().document().cast);
  offer(Selection::Kind::kObject, workspace.project().document().objects);
  if (workspace.project().place() != nullptr) {
    offer(Selection::Kind::kOccluder, workspace.project().place()->occluders);
    offer(Selection::Kind::kProbe, workspace.project().place()->probes);
  }
  offer(Selection::Kind::kPlace, workspace.project().document().places);
  return named;
}

// Goes to the time of the problem, and to the item of the timeline, otherwise to the line of the
// script, otherwise to the object.
void GoTo(editor::Workspace& workspace,
          Selection& selection,
          Input& input,
          EditorActions& actions,
          const std::string& problem) {
  const ProblemPlace place =
      PlaceOfProblem(problem, workspace.project().paths().Drama().filename().string());
  if (place.seconds >= 0.0) {
    workspace.playback().SetPlaying(false);
    workspace.playback().SetTime(place.seconds);
  }
  std::optional<drama::TimelineItem> item;
  if (const drama::TimelineText* text = workspace.project().script().timeline()) {
    item = place.script_line > 0 ? ItemOnLine(*text, place.script_line)
           : !place.line.empty() ? ItemSaying(*text, place.line)
                                 : std::nullopt;
  }
  if (item) {
    actions.push_back(SelectTimelineItem{*item});
    actions.push_back(OpenTab{BottomTab::kTimeline});
    input.focus = Focus::kTimeline;
  } else if (place.script_line > 0) {
    actions.push_back(GoToScriptLine{place.script_line});
  } else if (const std::optional<Selection> named = NamedThing(workspace, problem)) {
    selection = *named;
  }
}

void DrawProblem(editor::Workspace& workspace,
                 Selection& selection,
                 Input& input,
                 EditorActions& actions,
                 const Problem& problem) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  const std::string text = problem.text.Translated(Tr);
  const ImVec2 size = ImGui::CalcTextSize(text.c_str(), nullptr, false, width - Px(30));
  if (ImGui::Selectable("##problem", false, ImGuiSelectableFlags_None, ImVec2(0, size.y + Px(4)))) {
    GoTo(workspace, selection, input, actions, problem.text.English());
  }
  Tip(Tr("Goes to its place: the item of the timeline, the line of the script, or the thing."));
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const float y = at.y + Px(2);
  draw.AddText(ImVec2(at.x + Px(2), y),
               Packed(problem.warning ? Colours().warning : Colours().error),
               IconText(problem.warning ? Icon::kWarning : Icon::kError).c_str());
  draw.AddText(ImGui::GetFont(), ImGui::GetFontSize(), ImVec2(at.x + Px(26), y),
               Packed(Colours().text), text.c_str(), nullptr, width - Px(30));
}

}  // namespace

int CountProblems(const editor::Workspace& workspace) {
  return static_cast<int>(Problems(workspace).size());
}

void DrawChecksTools(editor::Workspace& workspace) {
  const bool busy = workspace.tasks().Running(editor::TaskKind::kChecking);
  ImGui::BeginDisabled(busy);
  if (ImGui::Button(busy ? Tr("Checking\xe2\x80\xa6") : Tr("Check the saved project"))) {
    workspace.jobs().Check();
  }
  ImGui::EndDisabled();
  Tooltip(
      Tr("Looks at every file, and runs the drama in every language "
         "(lararium-editor check)."));
  if (workspace.project().commands().dirty()) {
    ImGui::SameLine(0.0f, Px(12));
    DimText(Tr("There are edits that are not saved."));
  }
}

void DrawChecks(editor::Workspace& workspace,
                Selection& selection,
                Input& input,
                EditorActions& actions) {
  const std::vector<Problem> problems = Problems(workspace);
  ImGui::BeginChild("list", ImVec2(0, 0), false, ImGuiWindowFlags_NavFlattened);
  if (problems.empty()) {
    Hint(workspace.jobs().checked()
             ? Tr("Nothing is wrong.")
             : Tr("Nothing is known to be wrong with the script. A check also "
                  "looks at files, lines and places."));
  }
  for (size_t i = 0; i < problems.size(); ++i) {
    ImGui::PushID(static_cast<int>(i));
    DrawProblem(workspace, selection, input, actions, problems[i]);
    ImGui::PopID();
  }
  ImGui::EndChild();
}

}  // namespace lararium::panels
