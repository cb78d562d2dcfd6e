#pragma once

// Dialogs that a button of an inspector opens, with ImGui::OpenPopup() of their title, beside those
// that the whole window can open (dialogs.h). What is typed into them is in EditorState::fields.

#include <functional>
#include <string>

namespace lararium::panels {

// Shows the dialog of a title, as long as it is open; where it was opened. content: draws it, and
// is true when it is done. Escape and its cross close it too.
void ShowInspectorDialog(const std::string& title, const std::function<bool()>& content);

}  // namespace lararium::panels
