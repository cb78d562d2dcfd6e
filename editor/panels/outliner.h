#pragma once

#include "editor/app/workspace.h"
#include "editor/panels/editor_state.h"

namespace lararium::panels {

// The list of all that the project has; a click selects.
void ShowOutliner(app::Workspace& workspace, EditorState& state);

}  // namespace lararium::panels
