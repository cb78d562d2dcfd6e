#pragma once

#include "editor/session/workspace.h"
#include "editor/panels/widgets/editor_state.h"

namespace lararium::panels {

void ShowMenuBar(editor::Workspace& workspace, EditorState& state);
void ShowToolbar(editor::Workspace& workspace, EditorState& state);

// Ctrl+S, Ctrl+Z, Ctrl+Shift+Z, W, E, R, 1, 2, 3, Space.
void HandleShortcuts(editor::Workspace& workspace, EditorState& state);

}  // namespace lararium::panels
