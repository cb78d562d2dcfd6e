#pragma once

// Decodes the sound of containers that libsndfile does not read: M4A of phones, MP4 and MOV of
// cameras, WMA and others of libav.

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "shared/core/status.h"

namespace lararium::bake {

struct DecodedSound {
  int rate = 0;  // Samples per second.
  int channels = 0;
  std::vector<float> samples;  // Interleaved.
};

// Decodes the best sound stream in memory, up to a number of seconds. Only containers that cannot
// name other files are opened. `where` names the sound in errors.
Result<DecodedSound> DecodeWithLibav(std::span<const std::byte> bytes,
                                     const std::string& where,
                                     double max_seconds);

}  // namespace lararium::bake
