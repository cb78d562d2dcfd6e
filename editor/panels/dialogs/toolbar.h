#pragma once

#include "editor/panels/widgets/editor_state.h"
#include "editor/session/workspace.h"

namespace lararium::panels {

void DrawMenuBar(editor::Workspace& workspace, EditorState& state);
void DrawToolbar(editor::Workspace& workspace, EditorState& state);

// Ctrl+S, Ctrl+Z, Ctrl+Shift+Z, W, E, R, 1, 2, 3, Space.
void HandleShortcuts(editor::Workspace& workspace, EditorState& state);

}  // namespace lararium::panels
