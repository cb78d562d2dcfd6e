#pragma once

// Reads and writes the field "acoustics" of a place in projects and bundles (docs/file-formats.md).

#include <string_view>

#include "shared/core/json_fwd.h"
#include "shared/core/status.h"
#include "shared/stage/acoustics.h"

namespace lararium::stage {

// Unknown fields are an error.
Result<Acoustics> ParseAcoustics(const JsonView& json);
Json FormatAcoustics(const Acoustics& acoustics);

// The name of a reverberation in files, such as "stone_room".
std::string_view ReverbName(Reverb reverb);

}  // namespace lararium::stage
