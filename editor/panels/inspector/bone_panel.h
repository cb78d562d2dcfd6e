#pragma once

#include "editor/panels/viewport/portrait_view.h"
#include "editor/session/workspace.h"

namespace lararium::panels {

// A table of the joints and bones of an imported figure: how each was found and what is doubtful.
// Each row can be changed.
void DrawBones(editor::Workspace& workspace,
               CastView& cast_view,
               const editor::CastDocument& member);

}  // namespace lararium::panels
