#include "editor/panels/inspector/outliner.h"

#include <imgui.h>

#include "editor/panels/widgets/icons.h"
#include "editor/panels/widgets/text.h"
#include "editor/panels/widgets/theme.h"
#include "editor/panels/widgets/widgets.h"

namespace lararium::panels {

namespace {

void Row(Selection& selection, Icon icon, const std::string& label, const Selection& own) {
  ImGui::PushID(static_cast<int>(own.kind));
  ImGui::PushID(own.name.c_str());
  ImGui::Indent(Px(6));
  if (ImGui::Selectable(WithIcon(icon, label).c_str(), selection == own)) {
    selection = own;
  }
  ImGui::Unindent(Px(6));
  ImGui::PopID();
  ImGui::PopID();
}

// A row for a check point, with a symbol for its verdict at this place.
void CheckPointRow(Selection& selection, const editor::CheckPointReport& point) {
  const ImVec2 from = ImGui::GetCursorScreenPos();
  const float right = ImGui::GetWindowPos().x + ImGui::GetWindowContentRegionMax().x;
  Row(selection, Icon::kCheckPoint, point.name, {Selection::Kind::kCheckPoint, point.name});
  ImGui::GetWindowDrawList()->AddText(ImVec2(right - Px(kIconPx + 2), from.y),
                                      Packed(VerdictColour(point.verdict)),
                                      IconText(VerdictIcon(point.verdict)).c_str());
}

// A row for a person or an object, with a thumbnail.
void PicturedRow(Selection& selection,
                 PictureTextures& pictures,
                 const Selection& own,
                 const std::string& label,
                 const editor::CastPictures::Picture& picture) {
  const bool person = own.kind == Selection::Kind::kActor;
  const float side = Px(34);
  ImGui::PushID(static_cast<int>(own.kind));
  ImGui::PushID(own.name.c_str());
  ImGui::Indent(Px(6));
  const ImVec2 from = ImGui::GetCursorPos();
  if (ImGui::Selectable("##pictured", selection == own, ImGuiSelectableFlags_None,
                        ImVec2(0, side))) {
    selection = own;
  }
  const ImVec2 after = ImGui::GetCursorPos();
  ImGui::SetCursorPos(from);
  DrawThumbnail(pictures, (person ? "person " : "object ") + own.name, picture, side,
                person ? ThumbnailOf::kPerson : ThumbnailOf::kThing);
  ImGui::SetCursorPos(
      ImVec2(from.x + side + Px(8), from.y + 0.5f * (side - ImGui::GetTextLineHeight())));
  ImGui::TextUnformatted(label.c_str());
  ImGui::SetCursorPos(after);
  ImGui::Unindent(Px(6));
  ImGui::PopID();
  ImGui::PopID();
}

// A heading with a button that adds to its list. does: the tooltip of that button.
void Section(const char* title,
             Dialogs* dialogs = nullptr,
             Dialog add = Dialog::kNone,
             const char* does = "") {
  ImGui::Dummy(ImVec2(0, Px(4)));
  ImGui::AlignTextToFramePadding();
  DimText(title);
  if (dialogs != nullptr) {
    const float width = ImGui::GetFrameHeight();
    ImGui::SameLine(ImGui::GetContentRegionMax().x - width);
    ImGui::PushID(static_cast<int>(add));
    if (ImGui::Button("+", ImVec2(width, 0))) {
      dialogs->Open(add);
    }
    Tip(does);
    ImGui::PopID();
  }
}

}  // namespace

void DrawOutliner(editor::Workspace& workspace,
                  Selection& selection,
                  CheckView& check,
                  PictureTextures& pictures,
                  Dialogs& dialogs) {
  using Kind = Selection::Kind;
  Row(selection, Icon::kProject, Tr("Project"), {Kind::kProject, ""});
  Section(Tr("Places"), &dialogs, Dialog::kTrain, Tr("Adds a place"));
  for (const editor::PlaceDocument& place : workspace.project().document().places) {
    const bool shown = workspace.project().place() == &place;
    const std::string label =
        shown ? place.label() : Text(Tr("%s (not shown)"), place.label().c_str());
    Row(selection, Icon::kPlace, label, {Kind::kPlace, place.name});
    if (!shown && selection == Selection{Kind::kPlace, place.name}) {
      workspace.project().SelectPlace(place.name);
      return;  // The document has changed.
    }
  }
  if (const editor::PlaceDocument* place = workspace.project().place()) {
    Section(Tr("On the stage"));
    Row(selection, Icon::kStage, Tr("Stage"), {Kind::kStage, ""});
    Row(selection, Icon::kPicks, Tr("Picks"), {Kind::kPicks, ""});
    Row(selection, Icon::kNudge, Tr("Camera nudge"), {Kind::kNudge, ""});
    Section(Tr("Light probes"), &dialogs, Dialog::kProbe, Tr("Adds a light probe"));
    for (const editor::ProbeDocument& probe : place->probes) {
      Row(selection, Icon::kProbe, probe.name, {Kind::kProbe, probe.name});
    }
    Section(Tr("Occluders"), &dialogs, Dialog::kOccluder, Tr("Adds an occluder"));
    for (const editor::OccluderDocument& occluder : place->occluders) {
      Row(selection, Icon::kOccluder, occluder.name, {Kind::kOccluder, occluder.name});
    }
  }
  Section(Tr("Cast"), &dialogs, Dialog::kCast, Tr("Adds a person"));
  for (const editor::CastDocument& member : workspace.project().document().cast) {
    PicturedRow(selection, pictures, {Kind::kActor, member.name}, member.label(),
                workspace.cast().pictures().Thumbnail(member.name));
  }
  Section(Tr("Objects"), &dialogs, Dialog::kObject, Tr("Adds an object"));
  for (const editor::ObjectDocument& object : workspace.project().document().objects) {
    PicturedRow(selection, pictures, {Kind::kObject, object.name}, object.name,
                workspace.cast().pictures().ObjectThumbnail(object.name));
  }
  if (workspace.project().place() != nullptr) {
    Section(Tr("Check points"), &dialogs, Dialog::kCheckPoint, Tr("Adds a check point"));
    for (const editor::CheckPointReport& point : CheckedPoints(workspace, check).points) {
      CheckPointRow(selection, point);
    }
  }
}

}  // namespace lararium::panels
