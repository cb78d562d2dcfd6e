#pragma once

// Check points: what to pick at every place, the error at the current place, and what to do about
// it.

#include <imgui.h>

#include "editor/jobs/check_points.h"
#include "editor/panels/dialogs/dialog_state.h"
#include "editor/panels/viewport/align_panel.h"
#include "editor/panels/widgets/icons.h"
#include "editor/session/workspace.h"

namespace lararium::panels {

// The last report on the check points, with its inputs.
struct CheckView {
  std::shared_ptr<const editor::ProjectDocument> document;
  std::shared_ptr<const vision::SceneDatabase> database;
  std::string place;
  geometry::Similarity3 map_from_picked;
  editor::CheckReport report;
};

// The report for the current place; computed again when an input has changed.
const editor::CheckReport& CheckedPoints(const editor::Workspace& workspace, CheckView& check);

// The selected check point; nullptr: none is selected.
const editor::CheckPointDocument* SelectedCheckPoint(const editor::Workspace& workspace,
                                                     const Selection& selection);

// The verdict as a colour and as a shape, for users who cannot distinguish the colours.
ImVec4 VerdictColour(editor::CheckPointReport::Verdict verdict);
Icon VerdictIcon(editor::CheckPointReport::Verdict verdict);

// The inspector of a check point.
void DrawCheckPoint(editor::Workspace& workspace,
                    Selection& selection,
                    ViewOptions& options,
                    PickTarget& picks,
                    CheckView& check,
                    const AlignView& align,
                    Input& input,
                    const editor::CheckPointDocument& point);

// Draws over a view, while a check point is selected: crosses at the known positions, rings at the
// located ones.
void DrawCheckPoints(const editor::Workspace& workspace,
                     const Selection& selection,
                     CheckView& check,
                     const ViewCamera& view,
                     ImDrawList& draw);

// The content of the dialog that adds a check point.
void CheckPointDialog(editor::Workspace& workspace,
                      Selection& selection,
                      ViewOptions& options,
                      Dialogs& dialogs);

}  // namespace lararium::panels
