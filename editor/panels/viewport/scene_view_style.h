#pragma once

// The viewpoint of the scene view: looking at the stage, at the whole map, or at the selection, and
// the keys that rotate and move it.

#include <Eigen/Core>
#include <span>

#include "editor/panels/widgets/editor_state.h"
#include "editor/session/workspace.h"

namespace lararium::panels {

// The initial viewpoint, at the stage of a place; nullptr: no place is shown.
OrbitCamera LookAtStage(const editor::PlaceDocument* place);

// Handles the keys of KeyScope::kAround.
void LookByKeys(EditorState& state, const Eigen::Vector2d& view_size_px);

// Performs PlaceView::look_at. points: of the map, in the world. Where the selection has no
// position: looks at the whole map.
void LookWhereAsked(const editor::Workspace& workspace,
                    std::span<const Eigen::Vector3f> points,
                    const Eigen::Vector2d& view_size_px,
                    EditorState& state);

}  // namespace lararium::panels
