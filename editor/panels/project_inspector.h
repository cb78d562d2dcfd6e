#pragma once

// What belongs to the whole project beside its title: its languages and its sounds.

#include "editor/app/workspace.h"
#include "editor/panels/editor_state.h"

namespace lararium::panels {

// In which languages voices are made, and which can be read.
void ShowLanguages(app::Workspace& workspace);

// The sounds that were brought in, and a button that brings in another.
void ShowSounds(app::Workspace& workspace, EditorState& state);
void BringInSoundButton(app::Workspace& workspace, EditorState& state);

}  // namespace lararium::panels
