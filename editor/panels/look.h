#pragma once

// Choosing how the editor looks.

#include "editor/app/settings.h"

namespace lararium::panels {

// As rows of buttons, and as entries of a menu.
void ShowLook(app::Settings& settings);
void LookMenu(app::Settings& settings);

}  // namespace lararium::panels
