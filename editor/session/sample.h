#pragma once

// The sample project that comes with the editor.

#include <filesystem>

#include "shared/core/status.h"

namespace lararium::editor {

// The original, beside the build tree of this program. Empty where it does not exist.
std::filesystem::path ShippedSample();

// The user's own copy below folder, made where it does not exist yet. shipped: the project to copy.
Result<std::filesystem::path> OwnSample(const std::filesystem::path& shipped,
                                        const std::filesystem::path& folder);

}  // namespace lararium::editor
