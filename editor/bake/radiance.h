#pragma once

// Pictures of the Radiance lighting tools (.hdr): a byte of mantissa for each of red, green
// and blue, and one of exponent for all three (Ward, "Real Pixels", Graphics Gems II, 1991).

#include <cstddef>
#include <span>
#include <string>

#include "editor/bake/probe.h"
#include "shared/core/status.h"

namespace lararium::bake {

// The whole picture or an error. Linear, in the file's units; its EXPOSURE is left alone.
// Rows from the top, columns from the left ("-Y height +X width"), as nearly all are.
Result<ProbeImage> ParseRadiance(std::span<const std::byte> bytes, const std::string& place);

}  // namespace lararium::bake
