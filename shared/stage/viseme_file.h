#pragma once

// Reads and writes LINE.visemes.json: mouth movements of a spoken line (docs/file-formats.md).

#include <string>
#include <string_view>

#include "shared/core/status.h"
#include "shared/human/face.h"

namespace lararium::stage {

// Error messages begin with `place` and name the field.
Result<human::VisemeTrack> ParseVisemes(std::string_view text, const std::string& place);
std::string FormatVisemes(const human::VisemeTrack& track);

}  // namespace lararium::stage
