#pragma once

#include "editor/app/workspace.h"
#include "editor/panels/editor_state.h"

namespace lararium::panels {

// Which bone of an imported figure is which joint, how it was found, and what is doubtful;
// each row can be changed.
void ShowBones(app::Workspace& workspace, EditorState& state, const app::CastDocument& member);

}  // namespace lararium::panels
