#pragma once

#include "editor/app/workspace.h"
#include "editor/panels/editor_state.h"
#include "editor/panels/tour.h"

namespace lararium::panels {

TourFacts FactsOf(const app::Workspace& workspace, const EditorState& state);

// The step at hand on a card over the views, until the tour ends.
void ShowTourCard(const app::Workspace& workspace, EditorState& state, Tour& tour);

}  // namespace lararium::panels
