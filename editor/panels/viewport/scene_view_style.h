#pragma once

// The viewpoint of the scene view: looking at the stage, at the whole map, or at the selection, and
// the keys that rotate and move it.

#include <Eigen/Core>
#include <span>

#include "editor/panels/viewport/pick_target.h"
#include "editor/panels/viewport/place_cards.h"
#include "editor/panels/widgets/selection.h"
#include "editor/session/workspace.h"

namespace lararium::panels {

// The initial viewpoint, at the stage of a place; nullptr: no place is shown.
OrbitCamera LookAtStage(const editor::PlaceDocument* place);

// Handles the keys of KeyScope::kAround.
void LookByKeys(PlaceView& place_view, const Input& input, const Eigen::Vector2d& view_size_px);

// Performs PlaceView::look_at. points: of the map, in the world. Where the selection has no
// position: looks at the whole map.
void LookWhereAsked(const editor::Workspace& workspace,
                    std::span<const Eigen::Vector3f> points,
                    const Eigen::Vector2d& view_size_px,
                    const Selection& selection,
                    const PickTarget& picks,
                    PlaceView& place_view);

}  // namespace lararium::panels
