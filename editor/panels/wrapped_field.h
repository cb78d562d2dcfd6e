#pragma once

#include <string>

namespace lararium::panels {

// A field for a text of several lines that wraps what is wider than itself. As wide as what is
// left, as high as its rows, but at least and at most so many. It takes nothing back by itself:
// what undoes the project's edits does, also while it is typed into. True while the text changes.
bool WrappedField(const char* id, std::string& text, int least_rows, int most_rows);
// Whether one of them has the keyboard.
bool TypesIntoWrappedField();

}  // namespace lararium::panels
