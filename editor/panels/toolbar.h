#pragma once

#include "editor/app/workspace.h"
#include "editor/panels/editor_state.h"

namespace lararium::panels {

void ShowMenuBar(app::Workspace& workspace, EditorState& state);
void ShowToolbar(app::Workspace& workspace, EditorState& state);

// Ctrl+S, Ctrl+Z, Ctrl+Shift+Z, W, E, R, 1, 2, 3, Space.
void HandleShortcuts(app::Workspace& workspace, EditorState& state);

}  // namespace lararium::panels
