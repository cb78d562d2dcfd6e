#pragma once

// What of a place is said beside its map: the recording to look at, its name, how it sounds.

#include "editor/app/workspace.h"
#include "editor/panels/editor_state.h"

namespace lararium::panels {

// A button that leads to the dialog about what the camera view plays.
void ShowRecordingToLookAt(app::Workspace& workspace,
                           EditorState& state,
                           const app::PlaceDocument& place);

// Its reverberation, and what is always heard there.
void ShowPlaceSound(app::Workspace& workspace, EditorState& state, const app::PlaceDocument& place);

// Buttons that give it another name and put it before the others.
void ShowPlaceName(app::Workspace& workspace, EditorState& state, const app::PlaceDocument& place);

}  // namespace lararium::panels
