#pragma once

#include "editor/app/workspace.h"
#include "editor/panels/editor_state.h"

namespace lararium::panels {

// A ball that turns a rotation in the axes of the view that is shown: through the camera or around
// the place. True while it does.
bool ShowTrackball(app::Workspace& workspace,
                   const EditorState& state,
                   Eigen::Quaterniond& world_from_thing);

}  // namespace lararium::panels
