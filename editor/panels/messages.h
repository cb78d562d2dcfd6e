#pragma once

#include "editor/app/workspace.h"

namespace lararium::panels {

// What happened, newest last: errors name the file and the remedy.
// What has to be chosen before anything can be saved.
void ShowMessagesTools(app::Workspace& workspace);
void ShowMessages(const app::Workspace& workspace);

// One line: the project, what runs in the background, with a button to cancel.
void ShowStatusBar(app::Workspace& workspace);

}  // namespace lararium::panels
