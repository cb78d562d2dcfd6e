#pragma once

// Edits of the table of lines. The window makes them.

#include <string>

#include "editor/bake/line_table.h"

namespace lararium::editor {

// Sets the text of a line in a language. Adds the line and the language where the table does not
// have them. An empty text removes the text. speaker: who says the line; used only when the line is
// added.
bake::LineTable WithText(bake::LineTable table,
                         const std::string& id,
                         const std::string& speaker,
                         const std::string& language,
                         const std::string& text);

// Adds a line without text. Does nothing where the table has a line with this id.
bake::LineTable WithLine(bake::LineTable table, const std::string& id, const std::string& speaker);

// Adds a language in which no line has a text yet. Does nothing where the table has the language.
bake::LineTable WithLanguage(bake::LineTable table, const std::string& language);

// Returns the first of "keeper1", "keeper2" and so on that is not the id of a line. stem: a plain
// name ("keeper").
std::string FreeLineId(const bake::LineTable& table, const std::string& stem);

}  // namespace lararium::editor
