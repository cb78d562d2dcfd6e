#pragma once

// The properties of the whole project besides its title: its languages and its sounds.

#include "editor/panels/widgets/editor_state.h"
#include "editor/session/workspace.h"

namespace lararium::panels {

// The languages of the voices and of the captions.
void DrawLanguages(editor::Workspace& workspace);

// The project's own sounds, and a button that adds one.
void DrawSounds(editor::Workspace& workspace, EditorState& state);
void BringInSoundButton(editor::Workspace& workspace, EditorState& state);

}  // namespace lararium::panels
