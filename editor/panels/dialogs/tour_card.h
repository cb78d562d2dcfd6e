#pragma once

#include "editor/panels/dialogs/dialog_state.h"
#include "editor/panels/dialogs/tour.h"
#include "editor/panels/widgets/input.h"
#include "editor/panels/widgets/selection.h"
#include "editor/panels/widgets/view_options.h"
#include "editor/session/workspace.h"

namespace lararium::panels {

TourFacts FactsOf(const editor::Workspace& workspace,
                  const Selection& selection,
                  const ViewOptions& options,
                  const Dialogs& dialogs);

// Shows the current step as a card over the views, until the tour ends.
void DrawTourCard(const editor::Workspace& workspace,
                  const Selection& selection,
                  const ViewOptions& options,
                  const Dialogs& dialogs,
                  Input& input,
                  Tour& tour);

}  // namespace lararium::panels
