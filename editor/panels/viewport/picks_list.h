#pragma once

// The picks in the training images of the current subject: a point of the stage, a check point, a
// point of a model, or the corners of an occluder. Each pick links to its image and can be removed
// alone.

#include "editor/panels/viewport/align_panel.h"
#include "editor/session/workspace.h"

namespace lararium::panels {

// A line for each pick in the inspector; nothing where there is none.
void DrawPicksList(editor::Workspace& workspace,
                   const Selection& selection,
                   ViewOptions& options,
                   PickTarget& picks,
                   const AlignView& align,
                   Input& input);

// Handles the keys of KeyScope::kPicks while the picks are shown. The map must have at least one
// image.
void HandlePickKeys(editor::Workspace& workspace,
                    const Selection& selection,
                    PickTarget& picks,
                    const AlignView& align,
                    const Input& input);

// Buttons to the previous and the next image with a pick.
void DrawPickSteps(const editor::Workspace& workspace,
                   const Selection& selection,
                   ViewOptions& options,
                   PickTarget& picks,
                   const AlignView& align,
                   Input& input);

}  // namespace lararium::panels
