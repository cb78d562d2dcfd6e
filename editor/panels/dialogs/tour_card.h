#pragma once

#include "editor/panels/dialogs/tour.h"
#include "editor/panels/widgets/editor_state.h"
#include "editor/session/workspace.h"

namespace lararium::panels {

TourFacts FactsOf(const editor::Workspace& workspace, const EditorState& state);

// Shows the current step as a card over the views, until the tour ends.
void DrawTourCard(const editor::Workspace& workspace, EditorState& state, Tour& tour);

}  // namespace lararium::panels
