#pragma once

#include "editor/app/workspace.h"

namespace lararium::panels {

// What happened, newest last: errors name the file and the remedy.
void ShowMessages(const app::Workspace& workspace);

// A sign at the corner of the button that was shown last, where warnings or errors were told
// after so many messages.
void MarkUnread(const app::Workspace& workspace, uint64_t read);

// One line: the project, what runs in the background, with a button to cancel; what has to be
// chosen before anything can be saved.
void ShowStatusBar(app::Workspace& workspace);

}  // namespace lararium::panels
