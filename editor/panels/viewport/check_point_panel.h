#pragma once

// Check points: what to pick at every place, the error at the current place, and what to do about
// it.

#include <imgui.h>

#include "editor/panels/widgets/editor_state.h"
#include "editor/panels/widgets/icons.h"
#include "editor/session/workspace.h"

namespace lararium::panels {

// The report for the current place; computed again when an input has changed.
const editor::CheckReport& CheckedPoints(const editor::Workspace& workspace, EditorState& state);

// The selected check point; nullptr: none is selected.
const editor::CheckPointDocument* SelectedCheckPoint(const editor::Workspace& workspace,
                                                     const EditorState& state);

// The verdict as a colour and as a shape, for users who cannot distinguish the colours.
ImVec4 VerdictColour(editor::CheckPointReport::Verdict verdict);
Icon VerdictIcon(editor::CheckPointReport::Verdict verdict);

// The inspector of a check point.
void DrawCheckPoint(editor::Workspace& workspace,
                    EditorState& state,
                    const editor::CheckPointDocument& point);

// Draws over a view, while a check point is selected: crosses at the known positions, rings at the
// located ones.
void DrawCheckPoints(const editor::Workspace& workspace,
                     EditorState& state,
                     const ViewCamera& view,
                     ImDrawList& draw);

// The content of the dialog that adds a check point.
void CheckPointDialog(editor::Workspace& workspace, EditorState& state);

}  // namespace lararium::panels
