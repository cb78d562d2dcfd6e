#pragma once

#include "editor/panels/inspector/recipe_panel.h"
#include "editor/session/workspace.h"

namespace lararium::panels {

// The voice of a cast member for lines that are not recorded: edits it and plays a sample.
void DrawVoice(editor::Workspace& workspace, editor::CastDocument& member, RecipeChange& change);

}  // namespace lararium::panels
