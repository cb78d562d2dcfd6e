#pragma once

// The problems of the project, with links to where they are.

#include "editor/panels/widgets/editor_actions.h"
#include "editor/panels/widgets/input.h"
#include "editor/panels/widgets/selection.h"
#include "editor/session/workspace.h"

namespace lararium::panels {

void DrawChecksTools(editor::Workspace& workspace);
void DrawChecks(editor::Workspace& workspace,
                Selection& selection,
                Input& input,
                EditorActions& actions);
// The number of known problems.
int CountProblems(const editor::Workspace& workspace);

}  // namespace lararium::panels
