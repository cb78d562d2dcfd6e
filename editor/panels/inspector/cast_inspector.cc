#include "editor/panels/inspector/cast_inspector.h"

#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cfloat>
#include <string>

#include "editor/document/cast_document.h"
#include "editor/document/titles.h"
#include "editor/panels/inspector/bone_panel.h"
#include "editor/panels/inspector/clips_panel.h"
#include "editor/panels/inspector/recipe_panel.h"
#include "editor/panels/inspector/voice_panel.h"
#include "editor/panels/widgets/text.h"
#include "editor/panels/widgets/theme.h"
#include "editor/panels/widgets/widgets.h"

namespace lararium::panels {
namespace {

bool DrawPlainFigure(editor::Workspace& workspace, editor::CastDocument& member) {
  bool changed = NumberProperty(workspace, TrIn("person", "Height"), member.height, 0.005,
                                editor::kMinHeight, editor::kMaxHeight, "%.2f m");
  changed |= ColourProperty(workspace, Tr("Tunic"), member.tunic);
  return changed;
}

// With the first change, a preset becomes the project's own recipe.
RecipeChange DrawRecipeOf(editor::Workspace& workspace,
                          CastView& cast_view,
                          editor::CastDocument& member) {
  Result<std::optional<import::CastRecipe>> recipe = editor::RecipeOf(member);
  if (!recipe.ok()) {
    Hint(recipe.message());
    return {};
  }
  RecipeChange change = DrawRecipe(workspace, cast_view, **recipe);
  if (change.any()) {
    member.recipe = **recipe;
    member.preset.clear();
  }
  return change;
}

std::string KindOf(const editor::CastDocument& member) {
  if (!member.preset.empty()) {
    return Text(Tr("From the preset %s."), member.preset.c_str());
  }
  if (member.recipe) {
    return Tr("Built from a recipe of this project.");
  }
  return member.model.empty() ? Tr("The plain figure that is built in.")
                              : Text(Tr("Imported: %s"), member.model.c_str());
}

RecipeChange DrawFigure(editor::Workspace& workspace,
                        CastView& cast_view,
                        editor::CastDocument& member) {
  if (member.recipe || !member.preset.empty()) {
    return DrawRecipeOf(workspace, cast_view, member);
  }
  RecipeChange change;
  if (!member.model.empty()) {
    DrawBones(workspace, cast_view, member);
  } else if (BeginProperties("plain figure")) {
    if (DrawPlainFigure(workspace, member)) {
      change.Drag(Sentence("figure"));
    }
    EndProperties();
  }
  return change;
}

// The title of a person, which can be changed, and the name, which the drama uses.
void DrawName(editor::Workspace& workspace, const editor::CastDocument& member) {
  if (!BeginProperties("name")) {
    return;
  }
  std::string title = member.label();
  PropertyLabel(Tr("Name"));
  if (ImGui::InputText("##title", &title) && (title.empty() || editor::IsTitle(title))) {
    workspace.project().Edit(
        Sentence("name of %s", {member.name}),
        [&, name = member.name](editor::ProjectDocument& document) {
          for (editor::CastDocument& known : document.cast) {
            if (known.name == name) {
              editor::SetTitle(title, known);
            }
          }
        },
        "name");
  }
  EndGestureWithItem(workspace);
  PropertyText(Tr("In the drama"), member.name);
  EndProperties();
}

}  // namespace

void DrawActor(editor::Workspace& workspace,
               Selection& selection,
               CastView& cast_view,
               PictureTextures& pictures,
               const Input& input,
               Dialogs& dialogs,
               const editor::CastDocument& member) {
  Heading(member.label().c_str());
  Hint(KindOf(member));
  DrawWarnings(workspace, workspace.project().paths().Human(member.name));
  DrawPortrait(workspace, cast_view, pictures, input, member, !member.model.empty());
  // The rest scrolls below the portrait, so that changes are always visible.
  constexpr float kLeast = 220.0f;  // logical pixels
  const float height = std::max(ImGui::GetContentRegionAvail().y, Px(kLeast));
  ImGui::BeginChild("figure", ImVec2(0, height), false, ImGuiWindowFlags_NavFlattened);
  editor::CastDocument edited = member;
  RecipeChange change = DrawFigure(workspace, cast_view, edited);
  DrawVoice(workspace, edited, change);
  if (change.any()) {
    workspace.project().Edit(
        Sentence("%s of %s", {change.what, member.label()}),
        [&edited](editor::ProjectDocument& document) {
          std::replace_if(
              document.cast.begin(), document.cast.end(),
              [&](const auto& m) { return m.name == edited.name; }, edited);
        },
        change.gesture);
  }
  DrawClips(workspace, dialogs, member);
  DrawName(workspace, member);
  Hint(Tr("Where people stand and what they do is written in the drama."));
  if (ImGui::Button(Tr("Remove"), ImVec2(-FLT_MIN, 0))) {
    workspace.project().Edit(Sentence("remove %s", {member.label()}),
                             [name = member.name](editor::ProjectDocument& document) {
                               std::erase_if(document.cast,
                                             [&](const auto& m) { return m.name == name; });
                             });
    selection = {};
  }
  ImGui::EndChild();
}

}  // namespace lararium::panels
