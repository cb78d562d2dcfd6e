#pragma once

// LINE.visemes.json: what a mouth does while a line is said (docs/file-formats.md).

#include <string>
#include <string_view>

#include "shared/core/status.h"
#include "shared/human/face.h"

namespace lararium::stage {

// place: what errors call the text; they name the field.
Result<human::VisemeTrack> ParseVisemes(std::string_view text, const std::string& place);
std::string FormatVisemes(const human::VisemeTrack& track);

}  // namespace lararium::stage
