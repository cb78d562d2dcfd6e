#pragma once

#include "editor/panels/viewport/portrait_view.h"
#include "editor/panels/viewport/view_tools.h"
#include "editor/session/workspace.h"

namespace lararium::panels {

// Shows the properties of the selected object.
void DrawInspector(editor::Workspace& workspace,
                   Selection& selection,
                   ViewOptions& options,
                   ViewTools& tools,
                   CastView& cast_view,
                   PictureTextures& pictures,
                   Input& input,
                   Dialogs& dialogs);

}  // namespace lararium::panels
