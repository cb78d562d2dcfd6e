#pragma once

// The sliders, parts and garments of a person's recipe.

#include <string>

#include "editor/import/cast/cast_recipe.h"
#include "editor/panels/viewport/portrait_view.h"
#include "editor/session/workspace.h"
#include "shared/core/sentence.h"

namespace lararium::panels {

// The changes that the widgets made in one frame.
struct RecipeChange {
  Sentence what;        // The name of the command, for example "nose hump"; empty: no change.
  std::string gesture;  // See CommandStack::Edit.

  bool any() const { return what != Sentence(); }
  // A choice is one command; a drag of a slider is one command.
  void Choose(const Sentence& name) { *this = {name, ""}; }
  void Drag(const Sentence& name) { *this = {name, "recipe " + name.English()}; }
};

// Shows the recipe and edits it.
RecipeChange DrawRecipe(editor::Workspace& workspace,
                        CastView& cast_view,
                        import::CastRecipe& recipe);

// Shows the part of the recipe below "Clothes".
void DrawWardrobe(editor::Workspace& workspace, import::CastRecipe& recipe, RecipeChange& change);

}  // namespace lararium::panels
