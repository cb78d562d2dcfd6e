#pragma once

#include "editor/app/workspace.h"
#include "editor/panels/editor_state.h"

namespace lararium::panels {

// The dialog that is open, if one is. What is wrong with what was typed is said
// in the dialog; Cancel always leads out.
void ShowDialogs(app::Workspace& workspace, EditorState& state);

}  // namespace lararium::panels
