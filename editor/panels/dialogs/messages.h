#pragma once

#include "editor/session/workspace.h"

namespace lararium::panels {

// The messages, newest last. Errors name the file and the remedy.
void DrawMessages(const editor::Workspace& workspace);

// Marks the corner of the last button where there are warnings or errors after the first read
// messages.
void MarkUnread(const editor::Workspace& workspace, uint64_t read);

// One line with the project, the tasks in the background, each with a button to cancel, and
// decisions that are needed before saving.
void DrawStatusBar(editor::Workspace& workspace);

}  // namespace lararium::panels
