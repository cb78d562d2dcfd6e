#pragma once

// The garments of the library: lists them, checks a file and how it lies on a person, and pictures
// one on a person.

#include <filesystem>
#include <string>

#include "editor/text/command_result.h"
#include "shared/core/progress.h"
#include "shared/core/status.h"

namespace lararium::editor {

struct WardrobeOptions {
  std::filesystem::path check = {};  // A file garment.json; empty: none.
  std::string picture = {};          // A garment of the library; empty: none.
  std::string on = {};               // The preset that wears it.
  std::filesystem::path out = {};    // The picture.
};

// Lists the library if neither a file nor a garment is given.
Result<CommandResult> RunWardrobe(const WardrobeOptions& options, Progress& progress);

}  // namespace lararium::editor
