#pragma once

#include "editor/panels/viewport/view_camera.h"
#include "editor/panels/widgets/view_options.h"
#include "editor/session/workspace.h"

namespace lararium::panels {

// A ball that changes a rotation in the axes of the open view (camera view or scene view). Returns
// true while it is dragged.
bool DrawTrackball(editor::Workspace& workspace,
                   const ViewOptions& options,
                   const OrbitCamera& orbit,
                   Eigen::Quaterniond& world_from_thing);

}  // namespace lararium::panels
