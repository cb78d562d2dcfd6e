#pragma once

#include "editor/panels/widgets/editor_state.h"
#include "editor/session/workspace.h"

namespace lararium::panels {

// The list of everything in the project; a click selects.
void DrawOutliner(editor::Workspace& workspace, EditorState& state);

}  // namespace lararium::panels
