#pragma once

// The dialog that makes a show of the project: what goes in and how large it is, the signature,
// what is still wrong; then how far it is; then what was written, and a try in the player.

#include "editor/app/workspace.h"
#include "editor/panels/editor_state.h"

namespace lararium::panels {

void ExportDialog(app::Workspace& workspace, EditorState& state);

}  // namespace lararium::panels
