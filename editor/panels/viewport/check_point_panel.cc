#include "editor/panels/viewport/check_point_panel.h"

#include <imgui_stdlib.h>

#include <algorithm>
#include <string>

#include "editor/jobs/check_points.h"
#include "editor/panels/viewport/gizmo_view.h"
#include "editor/panels/viewport/picks_list.h"
#include "editor/panels/widgets/text.h"
#include "editor/panels/widgets/theme.h"
#include "editor/panels/widgets/widgets.h"
#include "shared/core/units.h"

namespace lararium::panels {

namespace {

using editor::CheckPointReport;
using editor::CheckReport;
using Verdict = CheckPointReport::Verdict;

const char* VerdictText(Verdict verdict) {
  switch (verdict) {
    case Verdict::kNotPicked:
      return Tr("not picked here");
    case Verdict::kNotLocated:
      return Tr("cannot be located");
    case Verdict::kPicksDisagree:
      return Tr("picks disagree");
    case Verdict::kWeak:
      return Tr("from one direction");
    case Verdict::kGood:
      return Tr("good");
    case Verdict::kOff:
      return Tr("off");
  }
  return "";
}

void Sign(Verdict verdict) {
  ImGui::TextColored(VerdictColour(verdict), "%s", IconText(VerdictIcon(verdict)).c_str());
  ImGui::SameLine(0.0f, Px(6));
}

void EditPoint(editor::Workspace& workspace,
               const std::string& name,
               const Sentence& command,
               const Eigen::Vector3d& position,
               std::string_view gesture) {
  workspace.project().Edit(
      command,
      [&](editor::ProjectDocument& document) {
        for (editor::CheckPointDocument& point : document.check_points) {
          if (point.name == name) {
            point.position = position;
          }
        }
      },
      gesture);
}

// The result for the point at this place.
void DrawHere(const CheckPointReport& here) {
  PropertyText(Tr("Here"), VerdictText(here.verdict));
  if (!here.located()) {
    return;
  }
  PropertyText(TrIn("column", "Picks"),
               Text(Tr("%d, agree to %.2f px"), here.anchor.picks, here.anchor.error_px));
  PropertyText(Tr("Off by"), Text(Tr("%.1f cm of the stage, %.2f px"),
                                  kCentimetresPerMetre * here.distance_m, here.distance_px));
  PropertyText(Tr("for each px"),
               Text("\xc2\xb1 %.1f cm", kCentimetresPerMetre * here.deviation_m));
}

void DrawPointButtons(editor::Workspace& workspace,
                      Selection& selection,
                      ViewOptions& options,
                      const std::string& name,
                      const CheckPointReport& here) {
  const ImVec2 wide(-FLT_MIN, 0);
  if (options.view != ViewKind::kPicks && ImGui::Button(Tr("Pick in the training images"), wide)) {
    options.view = ViewKind::kPicks;
  }
  ImGui::BeginDisabled(!here.located());
  if (ImGui::Button(Tr("Its position is where it was picked here"), wide)) {
    EditPoint(workspace, name, Sentence("move %s", {name}), here.found, "");
  }
  ImGui::EndDisabled();
  ImGui::BeginDisabled(here.verdict == Verdict::kNotPicked);
  if (ImGui::Button(Tr("Clear its picks here"), wide)) {
    workspace.project().EditPlace(Sentence("clear picks"), [&](editor::PlaceDocument& place) {
      editor::ClearCheckPicks(place, name);
    });
  }
  ImGui::EndDisabled();
  if (ImGui::Button(Tr("Remove"), wide)) {
    workspace.project().Edit(Sentence("remove %s", {name}), [&](editor::ProjectDocument& document) {
      editor::RemoveCheckPoint(document, name);
    });
    selection = {};
  }
}

// Columns: point, centimetres, pixels.
void DrawTable(Selection& selection, const CheckReport& report) {
  if (!ImGui::BeginTable("points", 3, ImGuiTableFlags_SizingStretchProp)) {
    return;
  }
  ImGui::TableSetupColumn(Tr("Point"), ImGuiTableColumnFlags_WidthStretch);
  ImGui::TableSetupColumn("cm", ImGuiTableColumnFlags_WidthFixed, Px(60));
  ImGui::TableSetupColumn("px", ImGuiTableColumnFlags_WidthFixed, Px(56));
  ImGui::PushStyleColor(ImGuiCol_Text, Colours().dim);
  ImGui::TableHeadersRow();
  ImGui::PopStyleColor();
  for (const CheckPointReport& point : report.points) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    Sign(point.verdict);
    const Selection own{Selection::Kind::kCheckPoint, point.name};
    if (ImGui::Selectable(point.name.c_str(), selection == own,
                          ImGuiSelectableFlags_SpanAllColumns)) {
      selection = own;
    }
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(
        point.located() ? Text("%.1f", kCentimetresPerMetre * point.distance_m).c_str() : "-");
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(point.located() ? Text("%.1f", point.distance_px).c_str() : "-");
  }
  ImGui::EndTable();
}

void DrawOutcome(editor::Workspace& workspace, const CheckReport& report) {
  const bool good = report.verdict == CheckReport::Verdict::kGood;
  const bool poor = report.verdict == CheckReport::Verdict::kPoor;
  Sign(good ? Verdict::kGood : poor ? Verdict::kOff : Verdict::kNotPicked);
  Heading(good ? Tr("Good") : poor ? Tr("Poor") : Tr("Not known yet"));
  ImGui::TextWrapped("%s", editor::CheckAdvice(report, true).c_str());
  const bool can_lay = report.map_from_stage && report.fit_good;
  ImGui::BeginDisabled(!can_lay);
  if (ImGui::Button(Tr("Lay the stage by the points"), ImVec2(-FLT_MIN, 0))) {
    const geometry::Similarity3 laid =
        workspace.map().loaded().picks.map_from_picked.Inverse() * *report.map_from_stage;
    workspace.project().EditPlace(
        Sentence("lay the stage by the points"),
        [&](editor::PlaceDocument& place) { place.picked_from_stage = laid; });
  }
  ImGui::EndDisabled();
}

void DrawName(editor::Workspace& workspace, Selection& selection, const std::string& name) {
  std::string typed = name;
  PropertyLabel(Tr("Name"));
  if (!ImGui::InputText("##name", &typed, ImGuiInputTextFlags_EnterReturnsTrue)) {
    return;
  }
  const auto& points = workspace.project().document().check_points;
  const bool taken =
      std::any_of(points.begin(), points.end(), [&](const auto& p) { return p.name == typed; });
  if (typed.empty() || typed.size() > editor::kMaxCheckPointName || taken) {
    return;
  }
  workspace.project().Edit(Sentence("name %s", {typed}), [&](editor::ProjectDocument& document) {
    editor::RenameCheckPoint(document, name, typed);
  });
  selection.name = typed;
}

}  // namespace

const CheckReport& CheckedPoints(const editor::Workspace& workspace, CheckView& check) {
  const auto document = workspace.project().commands().snapshot();
  const editor::LoadedMap& loaded = workspace.map().loaded();
  const editor::PlaceDocument* place = workspace.project().place();
  if (place == nullptr || loaded.database == nullptr) {
    check = {};
    for (const editor::CheckPointDocument& point : document->check_points) {
      editor::CheckPointReport& unknown = check.report.points.emplace_back();
      unknown.name = point.name;
      unknown.on_stage = point.position;
    }
    return check.report;
  }
  if (check.document != document || check.database != loaded.database ||
      check.place != place->name || check.map_from_picked != loaded.picks.map_from_picked) {
    check.document = document;
    check.database = loaded.database;
    check.place = place->name;
    check.map_from_picked = loaded.picks.map_from_picked;
    check.report = editor::CheckStaging(*document, *place, *loaded.database, check.map_from_picked);
  }
  return check.report;
}

const editor::CheckPointDocument* SelectedCheckPoint(const editor::Workspace& workspace,
                                                     const Selection& selection) {
  const auto& points = workspace.project().document().check_points;
  const auto found = std::find_if(points.begin(), points.end(),
                                  [&](const auto& p) { return p.name == selection.name; });
  const bool selected = selection.kind == Selection::Kind::kCheckPoint;
  return selected && found != points.end() ? &*found : nullptr;
}

ImVec4 VerdictColour(Verdict verdict) {
  switch (verdict) {
    case Verdict::kGood:
      return Colours().good;
    case Verdict::kNotPicked:
      return Colours().dim;
    default:
      return Colours().warning;
  }
}

Icon VerdictIcon(Verdict verdict) {
  switch (verdict) {
    case Verdict::kGood:
      return Icon::kGood;
    case Verdict::kNotPicked:
      return Icon::kNothingYet;
    case Verdict::kNotLocated:
      return Icon::kUnclear;
    default:
      return Icon::kWarning;
  }
}

void DrawCheckPoint(editor::Workspace& workspace,
                    Selection& selection,
                    ViewOptions& options,
                    PickTarget& picks,
                    CheckView& check,
                    const AlignView& align,
                    Input& input,
                    const editor::CheckPointDocument& point) {
  // Copied, because edits below change it.
  const CheckReport report = CheckedPoints(workspace, check);
  const auto found = std::find_if(report.points.begin(), report.points.end(),
                                  [&](const auto& p) { return p.name == point.name; });
  const CheckPointReport here = found == report.points.end() ? CheckPointReport() : *found;
  const std::string name = point.name;
  Heading(name.c_str());
  Hint(
      Tr("A point of the stage that is looked for at every place: by three of them it shows "
         "whether the stage lies at each place as it should."));
  if (BeginProperties("check point")) {
    DrawName(workspace, selection, name);
    Eigen::Vector3d position = point.position;
    if (VectorProperty(workspace, Tr("Position"), position, 0.005, "%.3f")) {
      EditPoint(workspace, name, Sentence("move %s", {name}), position, "check point");
    }
    DrawHere(here);
    EndProperties();
  }
  ImGui::Dummy(ImVec2(0, Px(4)));
  Heading(Text(Tr("All of them at %s"), workspace.project().place()->label().c_str()).c_str());
  DrawTable(selection, report);
  DrawOutcome(workspace, report);
  ImGui::Dummy(ImVec2(0, Px(4)));
  DrawPicksList(workspace, selection, options, picks, align, input);
  DrawPointButtons(workspace, selection, options, name, here);
}

void DrawCheckPoints(const editor::Workspace& workspace,
                     const Selection& selection,
                     CheckView& check,
                     const ViewCamera& view,
                     ImDrawList& draw) {
  if (workspace.project().place() == nullptr ||
      SelectedCheckPoint(workspace, selection) == nullptr) {
    return;
  }
  const geometry::Similarity3& world_from_stage = workspace.project().place()->picked_from_stage;
  for (const CheckPointReport& point : CheckedPoints(workspace, check).points) {
    const bool selected = point.name == selection.name;
    const ImU32 packed = Packed(selected ? OverPicture().accent : OverPicture().warning);
    const auto expected = view.Project(world_from_stage * point.on_stage);
    if (point.located()) {
      DrawWorldLine(view, world_from_stage * point.on_stage, world_from_stage * point.found, packed,
                    Px(1.5f), draw);
      if (const auto pixel = view.Project(world_from_stage * point.found)) {
        draw.AddCircle(ToImGui(*pixel), Px(6), packed, 0, Px(1.5f));
      }
    }
    if (expected) {
      DrawCross(ToImGui(*expected), packed, draw);
      LabelMark(ToImGui(*expected), point.name, Packed(OverPicture().text), draw);
    }
  }
}

void CheckPointDialog(editor::Workspace& workspace,
                      Selection& selection,
                      ViewOptions& options,
                      Dialogs& dialogs) {
  Hint(
      Tr("Something that you will find at every place, such as a corner of the counter. Click it "
         "in two training images of each place; its position on the stage is typed, or taken "
         "from the first place."));
  std::string& name = dialogs.fields.name;
  if (BeginProperties("check point")) {
    PropertyLabel(Tr("Name"));
    if (ImGui::IsWindowAppearing()) {
      ImGui::SetKeyboardFocusHere();
    }
    ImGui::InputText("##name", &name);
    EndProperties();
  }
  const auto& points = workspace.project().document().check_points;
  DialogProblem problem;
  if (name.empty()) {
    problem = Missing(Tr("It needs a name."));
  } else if (name.size() > editor::kMaxCheckPointName) {
    problem = Wrong(Tr("The name is too long."));
  } else if (std::any_of(points.begin(), points.end(),
                         [&](const auto& p) { return p.name == name; })) {
    problem = Wrong(Tr("That name is taken."));
  } else if (points.size() >= editor::kMaxCheckPoints) {
    problem = Wrong(Tr("There are too many already."));
  }
  const DialogAnswer answer = DialogButtons(Tr("Add"), problem);
  if (answer != DialogAnswer::kNone) {
    dialogs.shown = Dialog::kNone;
  }
  if (answer == DialogAnswer::kAct) {
    workspace.project().Edit(Sentence("add %s", {name}), [&](editor::ProjectDocument& document) {
      document.check_points.push_back({name, {}});
    });
    selection = {Selection::Kind::kCheckPoint, name};
    options.view = ViewKind::kPicks;
  }
}

}  // namespace lararium::panels
