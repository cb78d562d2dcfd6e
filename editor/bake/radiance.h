#pragma once

// Reads pictures of the Radiance lighting tools (.hdr). A pixel has one byte of mantissa for
// each of red, green and blue, and a shared byte of exponent (Ward, "Real Pixels", Graphics
// Gems II, 1991).

#include <cstddef>
#include <span>
#include <string>

#include "editor/bake/probe.h"
#include "shared/core/status.h"

namespace lararium::bake {

// Gives the complete picture or an error. Values are linear radiance: what is stored, divided by
// the header's EXPOSURE and COLORCORR, each of which may be repeated. PRIMARIES are converted to
// those of BT.709. Rows and columns may come in every order.
Result<ProbeImage> ParseRadiance(std::span<const std::byte> bytes, const std::string& where);

}  // namespace lararium::bake
