#pragma once

#include "editor/panels/dialogs/dialog_state.h"
#include "editor/session/workspace.h"

namespace lararium::panels {

// The recorded motions of a cast member: name, length and whether they repeat. Adds and removes
// motions.
void DrawClips(editor::Workspace& workspace, Dialogs& dialogs, const editor::CastDocument& member);

}  // namespace lararium::panels
