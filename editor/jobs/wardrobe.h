#pragma once

// The garments of the library: lists them, checks a file and how it lies on a person, and pictures
// some on a person.

#include <filesystem>
#include <string>
#include <vector>

#include "editor/text/command_result.h"
#include "shared/core/progress.h"
#include "shared/core/status.h"

namespace lararium::editor {

struct WardrobeOptions {
  std::filesystem::path check = {};       // A file garment.json; empty: none.
  std::vector<std::string> picture = {};  // Garments of the library, in the order of dressing.
  std::string on = {};                    // The preset that wears the garments.
  std::filesystem::path out = {};         // The picture.
};

// Lists the library if neither a file nor a garment is given.
Result<CommandResult> RunWardrobe(const WardrobeOptions& options, Progress& progress);

}  // namespace lararium::editor
