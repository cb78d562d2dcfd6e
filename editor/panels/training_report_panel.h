#pragma once

#include "editor/app/workspace.h"
#include "editor/panels/editor_state.h"

namespace lararium::panels {

// While Dialog::kTrainingReport is open: what the training of the place at hand came to, and what
// to film next.
void TrainingReportDialog(app::Workspace& workspace, EditorState& state);

}  // namespace lararium::panels
