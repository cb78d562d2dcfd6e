#pragma once

// Edits of the table of lines, as the window makes them.

#include <string>

#include "editor/bake/line_table.h"

namespace lararium::app {

// The table with a text of a line; a line or a language that it has not is added. An empty
// text is none. speaker: of a line that is added.
bake::LineTable WithText(bake::LineTable table,
                         const std::string& id,
                         const std::string& speaker,
                         const std::string& language,
                         const std::string& text);

// The table with a line that has no text yet. Nothing changes where the id is taken.
bake::LineTable WithLine(bake::LineTable table, const std::string& id, const std::string& speaker);

// The table with a further language, which no line has a text in yet.
bake::LineTable WithLanguage(bake::LineTable table, const std::string& language);

// "keeper1", "keeper2" and so on: the first that is no line yet. stem: a plain name.
std::string FreeLineId(const bake::LineTable& table, const std::string& stem);

}  // namespace lararium::app
