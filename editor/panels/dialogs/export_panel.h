#pragma once

// The dialog that exports the project: first its content, size, signature and problems, then the
// progress, then the result, which can be tried in the player.

#include "editor/panels/dialogs/dialog_state.h"
#include "editor/panels/widgets/editor_actions.h"
#include "editor/session/workspace.h"

namespace lararium::panels {

void ExportDialog(editor::Workspace& workspace, Dialogs& dialogs, EditorActions& actions);

}  // namespace lararium::panels
