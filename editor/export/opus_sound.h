#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "shared/core/status.h"

namespace lararium::exporter {

// Encodes a sound as Ogg Opus (RFC 7845) of the same length. Voices, of one channel and a low rate,
// get about 32 kbit/s, other sounds about 64 for each channel.
Result<std::vector<std::byte>> EncodeOpus(std::span<const std::byte> sound,
                                          const std::string& where);

}  // namespace lararium::exporter
