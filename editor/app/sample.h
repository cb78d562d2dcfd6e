#pragma once

// The sample project that comes with the editor.

#include <filesystem>

#include "shared/core/status.h"

namespace lararium::app {

// As it came: beside the build tree that this program runs from. Empty where it is not there.
std::filesystem::path ShippedSample();

// The person's own copy of it below folder, to be edited freely; made where it is not there.
// shipped: the project to copy.
Result<std::filesystem::path> OwnSample(const std::filesystem::path& shipped,
                                        const std::filesystem::path& folder);

}  // namespace lararium::app
