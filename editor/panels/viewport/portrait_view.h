#pragma once

#include "editor/panels/widgets/editor_state.h"
#include "editor/session/workspace.h"

namespace lararium::panels {

// The portrait of a person, as wide as the panel. It rotates by dragging, or with the arrow keys
// while it has the keyboard focus; the framing is chosen below. The old picture stays while the
// person is built again. bones: draws the skeleton over it; a click on a joint highlights it.
void DrawPortrait(editor::Workspace& workspace,
                  EditorState& state,
                  const editor::CastDocument& member,
                  bool bones);

}  // namespace lararium::panels
