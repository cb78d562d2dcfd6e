#pragma once

#include "editor/app/workspace.h"
#include "editor/panels/editor_state.h"

namespace lararium::panels {

// The numbers of the selected thing.
void ShowInspector(app::Workspace& workspace, EditorState& state);

}  // namespace lararium::panels
