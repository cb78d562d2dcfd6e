#pragma once

// The result of a subcommand, for people and for programs.

#include <string>

#include "shared/core/json.h"

namespace lararium::editor {

struct CommandResult {
  std::string text;  // Lines of text for people.
  Json json = Json::object();
  bool failed = false;  // The command has run, but its result is negative (check found problems).
};

}  // namespace lararium::editor
