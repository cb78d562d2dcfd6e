#pragma once

// Dialogs that a button of an inspector opens, by ImGui::OpenPopup() with their title. Dialogs that
// are opened from anywhere are in dialogs.h. Their input is in Dialogs::fields.

#include <functional>
#include <string>

namespace lararium::panels {

// Shows the dialog with that title while it is open. Call it where it was opened. content: draws
// the dialog and returns true when it is done. Escape and the close button close it too.
void DrawInspectorDialog(const std::string& title, const std::function<bool()>& content);

}  // namespace lararium::panels
