#pragma once

// Describes the field "acoustics" of a place in projects and bundles (docs/file-formats.md).

#include <string_view>

#include "shared/core/json_fields.h"
#include "shared/stage/acoustics.h"

namespace lararium::stage {

// Unknown fields are an error.
void DescribeFields(Fields& fields, Acoustics& acoustics);

// The name of a reverberation in files, such as "stone_room".
std::string_view ReverbName(Reverb reverb);

}  // namespace lararium::stage
