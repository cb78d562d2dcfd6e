#pragma once

#include "editor/panels/widgets/selection.h"
#include "editor/session/workspace.h"

namespace lararium::panels {

// The inspector of an object: its model and its pose at the beginning.
void DrawObject(editor::Workspace& workspace,
                Selection& selection,
                const editor::ObjectDocument& object);

}  // namespace lararium::panels
