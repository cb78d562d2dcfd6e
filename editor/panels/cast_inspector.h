#pragma once

#include "editor/app/workspace.h"
#include "editor/panels/editor_state.h"

namespace lararium::panels {

// A member of the cast: what its figure is made of, its voice and its recorded motions. Changes are
// seen in the camera's picture once the figure is built anew.
void ShowActor(app::Workspace& workspace, EditorState& state, const app::CastDocument& member);

}  // namespace lararium::panels
