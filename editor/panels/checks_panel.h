#pragma once

// What is wrong with the project, and the way to it.

#include "editor/app/workspace.h"
#include "editor/panels/editor_state.h"

namespace lararium::panels {

void ShowChecksTools(app::Workspace& workspace);
void ShowChecks(app::Workspace& workspace, EditorState& state);
// How many problems are known.
int CountProblems(const app::Workspace& workspace);

}  // namespace lararium::panels
