#pragma once

// The picks of what is picked in the training images now: a point of the stage, a check point, a
// point of a model, or the corners of an occluder. Each leads to its image, and is removed alone.

#include "editor/app/workspace.h"
#include "editor/panels/editor_state.h"

namespace lararium::panels {

// In the inspector, a line for each pick; nothing where there is none.
void ShowPicksList(app::Workspace& workspace, EditorState& state);

// The keys of KeyScope::kPicks, while the picks are shown. The map has at least one image.
void HandlePickKeys(app::Workspace& workspace, EditorState& state);

// Buttons that lead to the image with a pick before and after the one that is shown.
void ShowPickSteps(const app::Workspace& workspace, EditorState& state);

}  // namespace lararium::panels
