#pragma once

#include "editor/panels/widgets/editor_state.h"
#include "editor/session/workspace.h"

namespace lararium::panels {

// Shows the properties of the selected object.
void DrawInspector(editor::Workspace& workspace, EditorState& state);

}  // namespace lararium::panels
