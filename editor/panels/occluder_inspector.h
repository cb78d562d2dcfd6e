#pragma once

#include "editor/app/workspace.h"
#include "editor/panels/editor_state.h"

namespace lararium::panels {

// Something real that hides people: where it is, and how it was made.
void ShowOccluder(app::Workspace& workspace,
                  EditorState& state,
                  const app::OccluderDocument& occluder);

}  // namespace lararium::panels
