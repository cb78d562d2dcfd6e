#pragma once

#include "editor/panels/dialogs/dialog_state.h"
#include "editor/panels/viewport/picture_textures.h"
#include "editor/panels/viewport/portrait_view.h"
#include "editor/panels/viewport/view_tools.h"
#include "editor/panels/widgets/input.h"
#include "editor/panels/widgets/selection.h"
#include "editor/panels/widgets/view_options.h"
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
