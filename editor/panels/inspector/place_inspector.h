#pragma once

// The properties of a place besides its map: the recording of the camera view, its name, its
// acoustics.

#include "editor/panels/dialogs/dialog_state.h"
#include "editor/panels/widgets/selection.h"
#include "editor/panels/widgets/view_options.h"
#include "editor/session/workspace.h"

namespace lararium::panels {

// A button that opens the dialog for the recording of the camera view.
void DrawRecordingToLookAt(editor::Workspace& workspace,
                           ViewOptions& options,
                           Dialogs& dialogs,
                           const editor::PlaceDocument& place);

// The reverberation and the background sound.
void DrawPlaceSound(editor::Workspace& workspace,
                    Dialogs& dialogs,
                    const editor::PlaceDocument& place);

// Buttons that rename the place and move it to the front.
void DrawPlaceName(editor::Workspace& workspace,
                   Selection& selection,
                   Dialogs& dialogs,
                   const editor::PlaceDocument& place);

}  // namespace lararium::panels
