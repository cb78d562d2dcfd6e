#pragma once

// Where the view around the place looks: back to the stage, at all of the map, at what is selected;
// and the keys that turn and move it.

#include <Eigen/Core>
#include <span>

#include "editor/app/workspace.h"
#include "editor/panels/editor_state.h"

namespace lararium::panels {

// As the view looks at first, at the stage where the place has it; nullptr: none is shown.
OrbitCamera LookAtStage(const app::PlaceDocument* place);

// The keys of KeyScope::kAround.
void LookByKeys(EditorState& state, const Eigen::Vector2d& view_size_px);

// Does what PlaceView::look_at asks for. points: of the map, in the world. Nothing that has a place
// is selected: all of the map.
void LookWhereAsked(const app::Workspace& workspace,
                    std::span<const Eigen::Vector3f> points,
                    const Eigen::Vector2d& view_size_px,
                    EditorState& state);

}  // namespace lararium::panels
