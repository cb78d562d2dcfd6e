#pragma once

// Check points: what of the stage is looked for at every place, how far off it is at the one that
// is shown, and what to do about it.

#include <imgui.h>

#include "editor/app/workspace.h"
#include "editor/panels/editor_state.h"
#include "editor/panels/icons.h"

namespace lararium::panels {

// Of the place that is shown; worked out anew when anything that it depends on has changed.
const app::CheckReport& CheckedPoints(const app::Workspace& workspace, EditorState& state);

// The one that is selected; nullptr: none is.
const app::CheckPointDocument* SelectedCheckPoint(const app::Workspace& workspace,
                                                  const EditorState& state);

// What says it at a glance, by shape as well as by colour.
ImVec4 VerdictColour(app::CheckPointReport::Verdict verdict);
Icon VerdictIcon(app::CheckPointReport::Verdict verdict);

// In the inspector.
void ShowCheckPoint(app::Workspace& workspace,
                    EditorState& state,
                    const app::CheckPointDocument& point);

// Over a view of the place while one is selected: crosses where the stage says that the points
// are, rings where the place's staging puts them.
void DrawCheckPoints(const app::Workspace& workspace,
                     EditorState& state,
                     const ViewCamera& view,
                     ImDrawList& draw);

// In the dialog that adds one.
void CheckPointDialog(app::Workspace& workspace, EditorState& state);

}  // namespace lararium::panels
