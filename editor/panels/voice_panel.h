#pragma once

#include "editor/app/workspace.h"
#include "editor/panels/recipe_panel.h"

namespace lararium::panels {

// How somebody speaks where their lines are not recorded: shows the voice, changes it in the
// member, and lets it be heard.
void ShowVoice(app::Workspace& workspace, app::CastDocument& member, RecipeChange& change);

}  // namespace lararium::panels
