#pragma once

// The library of which people of a cast are built: where it is, and how it comes to a machine.

#include <filesystem>
#include <optional>

#include "shared/core/progress.h"
#include "shared/core/status.h"

namespace lararium::editor {

// The folder of the library: LARARIUM_CAST_LIBRARY if it is set, the one that FetchCastLibrary()
// made, or "cast-library" in a folder above the program, as in a build tree. nullopt: there is
// none.
std::optional<std::filesystem::path> FindCastLibrary();

// Fetches the library with npm into the user's data folder. After a failure or a cancellation, a
// library that was there before is unchanged.
Status FetchCastLibrary(Progress& progress);

}  // namespace lararium::editor
