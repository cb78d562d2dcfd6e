#pragma once

#include "editor/panels/dialogs/dialog_state.h"
#include "editor/panels/viewport/portrait_view.h"
#include "editor/panels/widgets/selection.h"
#include "editor/session/workspace.h"

namespace lararium::panels {

// The inspector of a cast member: its figure, voice and recorded motions. The camera's picture
// shows changes after the figure was built again.
void DrawActor(editor::Workspace& workspace,
               Selection& selection,
               CastView& cast_view,
               PictureTextures& pictures,
               const Input& input,
               Dialogs& dialogs,
               const editor::CastDocument& member);

}  // namespace lararium::panels
