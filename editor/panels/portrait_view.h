#pragma once

#include "editor/app/workspace.h"
#include "editor/panels/editor_state.h"

namespace lararium::panels {

// The person as they are now, as wide as the panel: turned by dragging, or by the arrows while the
// keyboard walks and has come to it, with what of them is seen chosen below. While they are made
// anew the older picture stays. bones: their skeleton over it; a click on a joint lights it.
void ShowPortrait(app::Workspace& workspace,
                  EditorState& state,
                  const app::CastDocument& member,
                  bool bones);

}  // namespace lararium::panels
