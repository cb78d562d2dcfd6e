#pragma once

#include "editor/panels/viewport/view_tools.h"
#include "editor/session/settings.h"
#include "editor/session/workspace.h"

namespace lararium::panels {

void DrawMenuBar(const PanelContext& context, BottomTab bottom, editor::Settings& settings);
void DrawToolbar(editor::Workspace& workspace,
                 ViewOptions& options,
                 GizmoTool& gizmo,
                 Dialogs& dialogs);

// Ctrl+S, Ctrl+Z, Ctrl+Shift+Z, W, E, R, 1, 2, 3, Space.
void HandleShortcuts(const PanelContext& context);

}  // namespace lararium::panels
