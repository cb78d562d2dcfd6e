#pragma once

#include <string>

namespace lararium::panels {

// A text field of several lines with line breaks at its width. It fills the remaining width and is
// as high as its rows, between least_rows and most_rows. It has no undo of its own: the project's
// undo works also while it is edited. Returns true while the text changes.
bool WrappedField(const char* id, std::string& text, int least_rows, int most_rows);
// Whether such a field has the keyboard.
bool TypesIntoWrappedField();

}  // namespace lararium::panels
