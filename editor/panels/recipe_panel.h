#pragma once

// What a person is made of: the sliders, parts and garments of a recipe.

#include <string>

#include "editor/app/workspace.h"
#include "editor/import/cast_recipe.h"
#include "editor/panels/editor_state.h"

namespace lararium::panels {

// What the widgets of one frame have changed.
struct RecipeChange {
  std::string what;     // names the command: "nose hump"; empty: nothing was changed
  std::string gesture;  // see CommandStack::Edit

  bool any() const { return !what.empty(); }
  // One choice is one command; one pull of a slider is one command.
  void Choose(const std::string& name) { *this = {name, ""}; }
  void Drag(const std::string& name) { *this = {name, "recipe " + name}; }
};

// Shows the recipe and changes it.
RecipeChange ShowRecipe(app::Workspace& workspace, EditorState& state, import::CastRecipe& recipe);

// The part of it below "Clothes".
void ShowWardrobe(app::Workspace& workspace, import::CastRecipe& recipe, RecipeChange& change);

}  // namespace lararium::panels
