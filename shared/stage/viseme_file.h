#pragma once

// Reads and writes LINE.visemes.json: mouth movements of a spoken line (docs/file-formats.md).

#include <string>
#include <string_view>

#include "shared/core/status.h"
#include "shared/human/face.h"

namespace lararium::stage {

// Error messages begin with `where` and name the field.
Result<human::VisemeTrack> ParseVisemes(std::string_view text, const std::string& where);
std::string FormatVisemes(const human::VisemeTrack& track);

}  // namespace lararium::stage
