#include "editor/panels/cast_inspector.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cfloat>
#include <string>

#include "editor/app/cast_document.h"
#include "editor/panels/widgets.h"

namespace lararium::panels {
namespace {

// A share from 0 to 1, or a number with a unit, of a recipe.
struct RecipeSlider {
  const char* label;
  float import::CastRecipe::*value;
  double min;
  double max;
  const char* format;
};

constexpr RecipeSlider kBodySliders[] = {
    {"Age", &import::CastRecipe::age, 1.0, 90.0, "%.0f years"},
    {"Woman to man", &import::CastRecipe::sex, 0.0, 1.0, "%.2f"},
    {"Weight", &import::CastRecipe::weight, 0.0, 1.0, "%.2f"},
    {"Muscle", &import::CastRecipe::muscle, 0.0, 1.0, "%.2f"},
    {"Proportions", &import::CastRecipe::proportions, 0.0, 1.0, "%.2f"}};
constexpr RecipeSlider kSkinSliders[] = {
    {"Stubble", &import::CastRecipe::stubble, 0.0, 1.0, "%.2f"},
    {"Weathering", &import::CastRecipe::weathering, 0.0, 1.0, "%.2f"},
    {"Asymmetry", &import::CastRecipe::asymmetry, 0.0, 1.0, "%.2f"}};

bool ShowSliders(app::Workspace& workspace,
                 std::span<const RecipeSlider> sliders,
                 import::CastRecipe& recipe) {
  bool changed = false;
  for (const RecipeSlider& slider : sliders) {
    double value = recipe.*slider.value;
    if (SliderProperty(workspace, slider.label, value, slider.min, slider.max, slider.format)) {
      recipe.*slider.value = static_cast<float>(value);
      changed = true;
    }
  }
  return changed;
}

bool ShowDescent(app::Workspace& workspace, import::CastRecipe& recipe) {
  bool changed = false;
  constexpr std::array<const char*, 3> kLabels = {"European", "African", "Asian"};
  for (int i = 0; i < 3; ++i) {
    double share = recipe.ethnicity[i];
    if (SliderProperty(workspace, kLabels[i], share, 0.0, 1.0, "%.2f")) {
      recipe.ethnicity[i] = static_cast<float>(share);
      changed = true;
    }
  }
  if (recipe.ethnicity.x + recipe.ethnicity.y + recipe.ethnicity.z <= 0.0f) {
    recipe.ethnicity.x = 0.01f;  // somebody's they must be
  }
  return changed;
}

bool ShowHeight(app::Workspace& workspace, import::CastRecipe& recipe) {
  double height = recipe.height.value_or(1.7f);
  if (!SliderProperty(workspace, "Height", height, app::kMinHeight, app::kMaxHeight, "%.2f m")) {
    return false;
  }
  recipe.height = static_cast<float>(height);
  return true;
}

bool ShowRecipe(app::Workspace& workspace, import::CastRecipe& recipe) {
  bool changed = ShowSliders(workspace, kBodySliders, recipe);
  changed |= ShowHeight(workspace, recipe);
  changed |= ShowDescent(workspace, recipe);
  changed |= ShowSliders(workspace, kSkinSliders, recipe);
  PropertyText("Hair", recipe.hair ? recipe.hair->name : "none");
  std::string garments;
  for (const Json& garment : recipe.garments) {
    garments += (garments.empty() ? "" : ", ") + garment.value("name", std::string("?"));
  }
  PropertyText("Wears", garments.empty() ? "nothing" : garments);
  return changed;
}

bool ShowPlainFigure(app::Workspace& workspace, app::CastDocument& member) {
  bool changed = NumberProperty(workspace, "Height", member.height, 0.005, app::kMinHeight,
                                app::kMaxHeight, "%.2f m");
  changed |= ColourProperty(workspace, "Tunic", member.tunic);
  return changed;
}

// A preset becomes the project's own recipe with the first change.
bool ShowRecipeOf(app::Workspace& workspace, app::CastDocument& member) {
  Result<std::optional<import::CastRecipe>> recipe = app::RecipeOf(member);
  if (!recipe.ok()) {
    PropertyText("Figure", recipe.message());
    return false;
  }
  PropertyText("Figure", member.preset.empty() ? "built from a recipe" : "preset " + member.preset);
  if (!ShowRecipe(workspace, **recipe)) {
    return false;
  }
  member.recipe = **recipe;
  member.preset.clear();
  return true;
}

bool ShowFigure(app::Workspace& workspace, app::CastDocument& member) {
  if (member.recipe || !member.preset.empty()) {
    return ShowRecipeOf(workspace, member);
  }
  if (!member.model.empty()) {
    PropertyText("Figure", member.model);
    return false;
  }
  PropertyText("Figure", "plain, built in");
  return ShowPlainFigure(workspace, member);
}

}  // namespace

void ShowActor(app::Workspace& workspace, EditorState& state, const app::CastDocument& member) {
  Heading(member.name.c_str());
  Hint("Where people stand and what they do is written in the drama.");
  app::CastDocument edited = member;
  bool changed = false;
  if (BeginProperties("actor")) {
    changed = ShowFigure(workspace, edited);
    for (const app::ClipDocument& clip : member.clips) {
      PropertyText("Clip", clip.name + ": " + clip.file);
    }
    PropertyText("Baked", workspace.paths().Shorten(workspace.paths().Human(member.name)));
    EndProperties();
  }
  if (changed) {
    workspace.Edit(
        "figure of " + member.name,
        [&edited](app::ProjectDocument& document) {
          std::replace_if(
              document.cast.begin(), document.cast.end(),
              [&](const auto& m) { return m.name == edited.name; }, edited);
        },
        "figure");
  }
  if (ImGui::Button("Remove", ImVec2(-FLT_MIN, 0))) {
    workspace.Edit("remove " + member.name, [name = member.name](app::ProjectDocument& document) {
      std::erase_if(document.cast, [&](const auto& m) { return m.name == name; });
    });
    state.selection = {};
  }
}

}  // namespace lararium::panels
