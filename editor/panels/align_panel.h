#pragma once

// An occluder's model is laid where the real thing is: by points that are clicked on the model and
// then in the training images, and by the map's points on its surface.

#include <imgui.h>

#include <cstddef>
#include <optional>

#include "editor/app/workspace.h"
#include "editor/panels/editor_state.h"

namespace lararium::panels {

// In the inspector, of an occluder that is a model.
void ShowAlignment(app::Workspace& workspace,
                   EditorState& state,
                   const app::OccluderDocument& occluder);

// The pair of the selected model whose point is clicked in the training images.
struct ModelPairInWork {
  const app::OccluderDocument* occluder = nullptr;  // nullptr: none
  size_t pair = 0;
};
ModelPairInWork PairInWork(const app::Workspace& workspace, const EditorState& state);

// How the pairs of the selected model fit; worked out anew when anything that it depends on has
// changed.
const app::AlignmentReport& Alignment(const app::Workspace& workspace,
                                      EditorState& state,
                                      const app::OccluderDocument& occluder);

// Over a view of the place while a model is selected: the points of its pairs, and from each a line
// to where it was picked. While a point is to be clicked on the model, also the one that is meant;
// then true, and the view's own handles rest.
bool ShowModelPoints(app::Workspace& workspace,
                     EditorState& state,
                     const ViewCamera& view,
                     bool hovered,
                     ImDrawList& draw);

}  // namespace lararium::panels
