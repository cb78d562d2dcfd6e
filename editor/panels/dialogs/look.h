#pragma once

// Settings of the editor's appearance.

#include "editor/session/settings.h"

namespace lararium::panels {

// Rows of buttons, and entries of a menu.
void DrawLook(editor::Settings& settings);
void LookMenu(editor::Settings& settings);

}  // namespace lararium::panels
