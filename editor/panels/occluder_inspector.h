#pragma once

#include "editor/app/workspace.h"
#include "editor/panels/editor_state.h"

namespace lararium::panels {

// Something real that hides people: how it was made, where it is, and what it does.
void ShowOccluder(app::Workspace& workspace,
                  EditorState& state,
                  const app::OccluderDocument& occluder);

// The sizes of a shape, each within what the others allow, as rows of a grid. True while one
// changes.
bool ShapeSizes(app::Workspace& workspace, app::OccluderShape& shape);

}  // namespace lararium::panels
