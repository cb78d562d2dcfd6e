#pragma once

// Keys of the scene view: the drags of the mouse, in steps.

#include <Eigen/Core>

#include "editor/panels/viewport/view_camera.h"
#include "editor/panels/widgets/keys.h"

namespace lararium::panels {

// Rotates, moves or zooms the orbit for an action of KeyScope::kAround. shift: moves instead of
// rotating. Returns false, and changes nothing, for other actions.
bool OrbitByKey(KeyAction action,
                bool shift,
                const Eigen::Vector2d& view_size_px,
                OrbitCamera& orbit);

}  // namespace lararium::panels
