#include "editor/panels/inspector/outliner.h"

#include <imgui.h>

#include "editor/panels/viewport/check_point_panel.h"
#include "editor/panels/widgets/icons.h"
#include "editor/panels/widgets/text.h"
#include "editor/panels/widgets/theme.h"
#include "editor/panels/widgets/widgets.h"

namespace lararium::panels {

namespace {

void Row(EditorState& state, Icon icon, const std::string& label, const Selection& selection) {
  ImGui::PushID(static_cast<int>(selection.kind));
  ImGui::PushID(selection.name.c_str());
  ImGui::Indent(Px(6));
  if (ImGui::Selectable(WithIcon(icon, label).c_str(), state.selection == selection)) {
    state.selection = selection;
  }
  ImGui::Unindent(Px(6));
  ImGui::PopID();
  ImGui::PopID();
}

// A row for a check point, with a symbol for its verdict at this place.
void CheckPointRow(EditorState& state, const editor::CheckPointReport& point) {
  const ImVec2 from = ImGui::GetCursorScreenPos();
  const float right = ImGui::GetWindowPos().x + ImGui::GetWindowContentRegionMax().x;
  Row(state, Icon::kCheckPoint, point.name, {Selection::Kind::kCheckPoint, point.name});
  ImGui::GetWindowDrawList()->AddText(ImVec2(right - Px(kIconPx + 2), from.y),
                                      Packed(VerdictColour(point.verdict)),
                                      IconText(VerdictIcon(point.verdict)).c_str());
}

// A row for a person or an object, with a thumbnail.
void PicturedRow(EditorState& state,
                 const Selection& selection,
                 const editor::CastPictures::Picture& picture) {
  const bool person = selection.kind == Selection::Kind::kActor;
  const float side = Px(34);
  ImGui::PushID(static_cast<int>(selection.kind));
  ImGui::PushID(selection.name.c_str());
  ImGui::Indent(Px(6));
  const ImVec2 from = ImGui::GetCursorPos();
  if (ImGui::Selectable("##pictured", state.selection == selection, ImGuiSelectableFlags_None,
                        ImVec2(0, side))) {
    state.selection = selection;
  }
  const ImVec2 after = ImGui::GetCursorPos();
  ImGui::SetCursorPos(from);
  DrawThumbnail(state.pictures, (person ? "person " : "object ") + selection.name, picture, side,
                person ? ThumbnailOf::kPerson : ThumbnailOf::kThing);
  ImGui::SetCursorPos(
      ImVec2(from.x + side + Px(8), from.y + 0.5f * (side - ImGui::GetTextLineHeight())));
  ImGui::TextUnformatted(selection.name.c_str());
  ImGui::SetCursorPos(after);
  ImGui::Unindent(Px(6));
  ImGui::PopID();
  ImGui::PopID();
}

// A heading with a button that adds to its list. does: the tooltip of that button.
void Section(const char* title,
             EditorState* state = nullptr,
             Dialog add = Dialog::kNone,
             const char* does = "") {
  ImGui::Dummy(ImVec2(0, Px(4)));
  ImGui::AlignTextToFramePadding();
  DimText(title);
  if (state != nullptr) {
    const float width = ImGui::GetFrameHeight();
    ImGui::SameLine(ImGui::GetContentRegionMax().x - width);
    ImGui::PushID(static_cast<int>(add));
    if (ImGui::Button("+", ImVec2(width, 0))) {
      OpenDialog(*state, add);
    }
    Tip(does);
    ImGui::PopID();
  }
}

}  // namespace

void DrawOutliner(editor::Workspace& workspace, EditorState& state) {
  using Kind = Selection::Kind;
  Row(state, Icon::kProject, Tr("Project"), {Kind::kProject, ""});
  Section(Tr("Places"), &state, Dialog::kTrain, Tr("Adds a place"));
  for (const editor::PlaceDocument& place : workspace.project().document().places) {
    const bool shown = workspace.project().place() == &place;
    const std::string label = shown ? place.name : Text(Tr("%s (not shown)"), place.name.c_str());
    Row(state, Icon::kPlace, label, {Kind::kPlace, place.name});
    if (!shown && state.selection == Selection{Kind::kPlace, place.name}) {
      workspace.project().SelectPlace(place.name);
      return;  // The document has changed.
    }
  }
  if (const editor::PlaceDocument* place = workspace.project().place()) {
    Section(Tr("On the stage"));
    Row(state, Icon::kStage, Tr("Stage"), {Kind::kStage, ""});
    Row(state, Icon::kPicks, Tr("Picks"), {Kind::kPicks, ""});
    Row(state, Icon::kNudge, Tr("Camera nudge"), {Kind::kNudge, ""});
    Section(Tr("Light probes"), &state, Dialog::kProbe, Tr("Adds a light probe"));
    for (const editor::ProbeDocument& probe : place->probes) {
      Row(state, Icon::kProbe, probe.name, {Kind::kProbe, probe.name});
    }
    Section(Tr("Occluders"), &state, Dialog::kOccluder, Tr("Adds an occluder"));
    for (const editor::OccluderDocument& occluder : place->occluders) {
      Row(state, Icon::kOccluder, occluder.name, {Kind::kOccluder, occluder.name});
    }
  }
  Section(Tr("Cast"), &state, Dialog::kCast, Tr("Adds a person"));
  for (const editor::CastDocument& member : workspace.project().document().cast) {
    PicturedRow(state, {Kind::kActor, member.name},
                workspace.cast().pictures().Thumbnail(member.name));
  }
  Section(Tr("Objects"), &state, Dialog::kObject, Tr("Adds an object"));
  for (const editor::ObjectDocument& object : workspace.project().document().objects) {
    PicturedRow(state, {Kind::kObject, object.name},
                workspace.cast().pictures().ObjectThumbnail(object.name));
  }
  if (workspace.project().place() != nullptr) {
    Section(Tr("Check points"), &state, Dialog::kCheckPoint, Tr("Adds a check point"));
    for (const editor::CheckPointReport& point : CheckedPoints(workspace, state).points) {
      CheckPointRow(state, point);
    }
  }
}

}  // namespace lararium::panels
