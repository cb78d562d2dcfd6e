#pragma once

// The result of a subcommand, for people and for programs.

#include <span>
#include <string>

#include "shared/core/json.h"

namespace lararium::editor {

struct CommandResult {
  std::string text;  // Lines of text for people.
  Json json = Json::object();
  bool failed = false;  // The command has run, but its result is negative (check found problems).
};

// Puts warnings before the text, and into the JSON as "warnings".
inline void AddWarnings(std::span<const std::string> warnings, CommandResult& result) {
  std::string text;
  for (const std::string& warning : warnings) {
    text += "warning: " + warning + "\n";
    result.json["warnings"].push_back(warning);
  }
  result.text.insert(0, text);
}

}  // namespace lararium::editor
