#pragma once

// The properties of the whole project besides its title: its languages and its sounds.

#include "editor/panels/dialogs/dialog_state.h"
#include "editor/session/workspace.h"

namespace lararium::panels {

// The languages of the voices and of the captions.
void DrawLanguages(editor::Workspace& workspace);

// The project's own sounds, and a button that adds one.
void DrawSounds(editor::Workspace& workspace, Dialogs& dialogs);
void BringInSoundButton(editor::Workspace& workspace, Dialogs& dialogs);

}  // namespace lararium::panels
