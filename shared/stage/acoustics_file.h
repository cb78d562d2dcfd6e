#pragma once

// The field "acoustics" of a place, in projects and in bundles (docs/file-formats.md).

#include <string_view>

#include "shared/core/json.h"
#include "shared/core/status.h"
#include "shared/stage/acoustics.h"

namespace lararium::stage {

// Fields that are not known are an error.
Result<Acoustics> ParseAcoustics(const JsonView& json);
Json FormatAcoustics(const Acoustics& acoustics);

// As files call it.
std::string_view ReverbName(Reverb reverb);

}  // namespace lararium::stage
