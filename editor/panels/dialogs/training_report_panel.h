#pragma once

#include "editor/panels/dialogs/dialog_state.h"
#include "editor/session/workspace.h"

namespace lararium::panels {

// Shows, while Dialog::kTrainingReport is open, the result of the current place's training and what
// to film next.
void TrainingReportDialog(editor::Workspace& workspace, Dialogs& dialogs);

}  // namespace lararium::panels
