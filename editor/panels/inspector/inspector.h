#pragma once

#include "editor/panels/viewport/portrait_view.h"
#include "editor/panels/viewport/view_tools.h"
#include "editor/session/workspace.h"

namespace lararium::panels {

// Shows the properties of the selected object.
void DrawInspector(const PanelContext& context);

}  // namespace lararium::panels
