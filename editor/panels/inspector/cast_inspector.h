#pragma once

#include "editor/panels/widgets/editor_state.h"
#include "editor/session/workspace.h"

namespace lararium::panels {

// The inspector of a cast member: its figure, voice and recorded motions. The camera's picture
// shows changes after the figure was built again.
void DrawActor(editor::Workspace& workspace,
               EditorState& state,
               const editor::CastDocument& member);

}  // namespace lararium::panels
