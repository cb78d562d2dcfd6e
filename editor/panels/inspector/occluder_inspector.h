#pragma once

#include "editor/panels/viewport/align_panel.h"
#include "editor/session/workspace.h"

namespace lararium::panels {

// The inspector of a real object that hides people: how it was made, its pose, and its effects.
void DrawOccluder(editor::Workspace& workspace,
                  Selection& selection,
                  ViewOptions& options,
                  PickTarget& picks,
                  const OrbitCamera& orbit,
                  AlignView& align,
                  Input& input,
                  const editor::OccluderDocument& occluder);

// Rows for the sizes of a shape, each limited by the other sizes. Returns true while one changes.
bool ShapeSizes(editor::Workspace& workspace, editor::OccluderShape& shape);

}  // namespace lararium::panels
