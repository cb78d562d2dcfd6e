#include "editor/panels/inspector/bone_panel.h"

#include <imgui.h>

#include <algorithm>
#include <cfloat>
#include <optional>
#include <string>

#include "editor/panels/widgets/text.h"
#include "editor/panels/widgets/theme.h"
#include "editor/panels/widgets/widgets.h"

namespace lararium::panels {
namespace {

ImVec4 ColourOf(const editor::BoneRow& row) {
  if (row.problem.empty()) {
    return row.bone.empty() ? Colours().dim : Colours().text;
  }
  return row.bone.empty() ? Colours().error : Colours().warning;
}

void Choose(editor::Workspace& workspace,
            const editor::CastDocument& member,
            const std::string& joint,
            const std::optional<std::string>& bone) {
  workspace.project().Edit(Sentence("bone of %s of %s", {joint, member.name}),
                           [&](editor::ProjectDocument& document) {
                             for (editor::CastDocument& known : document.cast) {
                               if (known.name == member.name) {
                                 editor::ChooseBone(joint, bone, known);
                               }
                             }
                           });
}

void JointCell(CastView& cast_view, const editor::BoneRow& row) {
  ImGui::AlignTextToFramePadding();
  ImGui::PushStyleColor(ImGuiCol_Text, ColourOf(row));
  if (ImGui::Selectable(row.joint.c_str(), cast_view.joint == row.joint)) {
    cast_view.joint = row.joint;
  }
  ImGui::PopStyleColor();
  if (!row.problem.empty() && ImGui::IsItemHovered()) {
    ImGui::SetTooltip("%s: %s", row.joint.c_str(), row.problem.c_str());
  }
}

void BoneCell(editor::Workspace& workspace,
              CastView& cast_view,
              const editor::CastDocument& member,
              const editor::BoneReview& review,
              const editor::BoneRow& row) {
  ImGui::SetNextItemWidth(-FLT_MIN);
  if (!ImGui::BeginCombo("##bone", row.bone.empty() ? "\xe2\x80\x93" : row.bone.c_str(),
                         ImGuiComboFlags_HeightLarge)) {
    return;
  }
  cast_view.joint = row.joint;
  if (member.bones.contains(row.joint) && ImGui::Selectable(Tr("as it is found"))) {
    Choose(workspace, member, row.joint, std::nullopt);
  }
  if (ImGui::Selectable(Tr("no such joint"))) {
    Choose(workspace, member, row.joint, "");
  }
  ImGui::Separator();
  for (size_t i = 0; i < review.bones.size(); ++i) {
    ImGui::PushID(static_cast<int>(i));
    if (ImGui::Selectable(review.bones[i].c_str(), review.bones[i] == row.bone)) {
      Choose(workspace, member, row.joint, review.bones[i]);
    }
    ImGui::PopID();
  }
  ImGui::EndCombo();
}

const char* FoundByText(import::FoundBy found_by) {
  switch (found_by) {
    case import::FoundBy::kSavedMap:
      return Tr("saved map");
    case import::FoundBy::kFile:
      return Tr("file");
    case import::FoundBy::kName:
      return Tr("name");
    case import::FoundBy::kStructure:
      return Tr("structure");
  }
  return "";
}

const char* HowFound(const editor::CastDocument& member, const editor::BoneRow& row) {
  if (member.bones.contains(row.joint)) {
    return Tr("by hand");
  }
  return row.found_by ? FoundByText(*row.found_by) : "\xe2\x80\x93";
}

void FoundCell(const editor::CastDocument& member, const editor::BoneRow& row) {
  ImGui::AlignTextToFramePadding();
  ImGui::PushStyleColor(ImGuiCol_Text, row.problem.empty() ? Colours().dim : ColourOf(row));
  ImGui::TextUnformatted(HowFound(member, row));
  ImGui::PopStyleColor();
  if (row.found_by && ImGui::IsItemHovered()) {
    ImGui::SetTooltip(Tr("%.0f%% sure%s%s"), static_cast<double>(100.0f * row.confidence),
                      row.problem.empty() ? "" : ": ", row.problem.c_str());
  }
}

// Shows joints that were found and those that a person needs; others only on request.
bool IsShown(const CastView& cast_view,
             const editor::CastDocument& member,
             const editor::BoneRow& row) {
  return cast_view.all_joints || !row.bone.empty() || !row.problem.empty() ||
         member.bones.contains(row.joint);
}

void DrawTable(editor::Workspace& workspace,
               CastView& cast_view,
               const editor::CastDocument& member,
               const editor::BoneReview& review) {
  constexpr ImGuiTableFlags kFlags = ImGuiTableFlags_SizingStretchProp | ImGuiTableFlags_RowBg;
  if (!ImGui::BeginTable("bones", 3, kFlags)) {
    return;
  }
  ImGui::TableSetupColumn(Tr("Joint"), ImGuiTableColumnFlags_WidthFixed, Px(112));
  ImGui::TableSetupColumn(Tr("Bone"), ImGuiTableColumnFlags_WidthStretch);
  ImGui::TableSetupColumn(Tr("Found by"), ImGuiTableColumnFlags_WidthFixed, Px(66));
  ImGui::TableHeadersRow();
  for (const editor::BoneRow& row : review.rows) {
    if (!IsShown(cast_view, member, row)) {
      continue;
    }
    ImGui::PushID(row.joint.c_str());
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    JointCell(cast_view, row);
    ImGui::TableNextColumn();
    BoneCell(workspace, cast_view, member, review, row);
    ImGui::TableNextColumn();
    FoundCell(member, row);
    ImGui::PopID();
  }
  ImGui::EndTable();
}

void DrawVerdict(const editor::BoneReview& review) {
  const auto problems =
      std::count_if(review.rows.begin(), review.rows.end(),
                    [](const editor::BoneRow& row) { return !row.problem.empty(); });
  if (problems == 0) {
    Hint(Tr("Every joint that a person needs was found."));
    return;
  }
  ImGui::PushStyleColor(ImGuiCol_Text, review.is_human ? Colours().warning : Colours().error);
  ImGui::TextWrapped(
      "%s",
      review.is_human
          ? Tr("A person; look over the rows in yellow.")
          : Tr("Not yet a person: without the joints in red it cannot walk, reach or look about. "
               "Choose their bones."));
  ImGui::PopStyleColor();
}

}  // namespace

void DrawBones(editor::Workspace& workspace,
               CastView& cast_view,
               const editor::CastDocument& member) {
  if (!Fold(Label(Tr("Bones"), "bones"), true)) {
    return;
  }
  const editor::BoneReview* review = workspace.cast().bone_review(member);
  if (review == nullptr) {
    Hint(workspace.tasks().Running(editor::TaskKind::kBoneReview)
             ? Tr("Reading the figure\xe2\x80\xa6")
             : Tr("The figure could not be read; the messages below say why."));
    return;
  }
  DrawVerdict(*review);
  CheckRow(Tr("All joints that people can have"), cast_view.all_joints);
  DrawTable(workspace, cast_view, member, *review);
  for (const std::string& note : review->notes) {
    Hint(note);
  }
  ImGui::BeginDisabled(workspace.tasks().Running(editor::TaskKind::kBoneReview));
  if (ImGui::Button(Tr("Save the map"), ImVec2(-FLT_MIN, 0))) {
    workspace.cast().SaveBones(member);
  }
  ImGui::EndDisabled();
  Hint(member.bone_map.empty() ? Tr("For other figures of the same make: cast --bone-map.")
                               : Text(Tr("Saved in %s"), member.bone_map.c_str()));
}

}  // namespace lararium::panels
