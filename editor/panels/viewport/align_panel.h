#pragma once

// Alignment of an occluder's model with the real object: by points that are picked on the model and
// in the training images, and by the map's points on its surface.

#include <imgui.h>

#include <cstddef>

#include "editor/panels/widgets/editor_state.h"
#include "editor/session/workspace.h"

namespace lararium::panels {

// The part of the inspector for an occluder that is a model.
void DrawAlignment(editor::Workspace& workspace,
                   EditorState& state,
                   const editor::OccluderDocument& occluder);

// The pair of the selected model that is being picked in the training images.
struct ModelPairInWork {
  const editor::OccluderDocument* occluder = nullptr;  // nullptr: none.
  size_t pair = 0;
};
ModelPairInWork PairInWork(const editor::Workspace& workspace, const EditorState& state);

// How the pairs of the selected model fit; computed again when an input has changed.
const editor::AlignmentReport& Alignment(const editor::Workspace& workspace,
                                         EditorState& state,
                                         const editor::OccluderDocument& occluder);

// Draws the point pairs of the selected model over a scene view, each with a line to the located
// pick. While the user picks a point on the model, also shows the point under the pointer and
// returns true; the view must then not use the pointer.
bool DrawModelPoints(editor::Workspace& workspace,
                     EditorState& state,
                     const ViewCamera& view,
                     bool hovered,
                     ImDrawList& draw);

}  // namespace lararium::panels
