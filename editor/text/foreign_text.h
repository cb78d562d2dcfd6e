#pragma once

// Texts of other programs (captions, tables, catalogues, behaviours), in any encoding.

#include <string>
#include <string_view>

#include "shared/core/status.h"

namespace lararium::editor {

struct ForeignText {
  std::string text;  // UTF-8 without a byte order mark; every line ends with '\n'.
  // For the user, if the encoding was guessed: names it and says what to do. Otherwise empty.
  std::string note;
};

// Reads UTF-8 and UTF-16 without doubt. Other bytes are read in the encoding that the text itself
// declares, as XML and PO files do; otherwise in the one that the frequencies of letters suggest
// (ICU's detector), which is a guess. Fails on bytes that are no text. `where` names the text in
// errors.
Result<ForeignText> DecodeText(std::string_view bytes,
                               const std::string& where,
                               const std::string& declared = "");

// The text without blanks, tabs, line ends and no-break spaces around it.
std::string_view TrimBlanks(std::string_view text);

}  // namespace lararium::editor
