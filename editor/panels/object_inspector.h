#pragma once

#include "editor/app/workspace.h"
#include "editor/panels/editor_state.h"

namespace lararium::panels {

// A thing on stage: what it is and where it is at the beginning.
void ShowObject(app::Workspace& workspace, EditorState& state, const app::ObjectDocument& object);

}  // namespace lararium::panels
