#pragma once

// The keys of the view around the place: what a drag of the mouse does, in steps.

#include <Eigen/Core>

#include "editor/panels/keys.h"
#include "editor/panels/view_camera.h"

namespace lararium::panels {

// Turns, moves or nears the orbit as an action of KeyScope::kAround says. shift: it moves in place
// of turning. False, and nothing has changed: the action is another one.
bool OrbitByKey(KeyAction action,
                bool shift,
                const Eigen::Vector2d& view_size_px,
                OrbitCamera& orbit);

}  // namespace lararium::panels
