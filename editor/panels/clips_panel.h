#pragma once

#include "editor/app/workspace.h"
#include "editor/panels/editor_state.h"

namespace lararium::panels {

// Somebody's recorded motions: what they are called, how long they are, whether they repeat;
// removes them and adds others.
void ShowClips(app::Workspace& workspace, EditorState& state, const app::CastDocument& member);

}  // namespace lararium::panels
