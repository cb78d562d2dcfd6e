#pragma once

#include "editor/panels/viewport/check_point_panel.h"
#include "editor/panels/viewport/picture_textures.h"
#include "editor/session/workspace.h"

namespace lararium::panels {

// The list of everything in the project; a click selects.
void DrawOutliner(editor::Workspace& workspace,
                  Selection& selection,
                  CheckView& check,
                  PictureTextures& pictures,
                  Dialogs& dialogs);

}  // namespace lararium::panels
