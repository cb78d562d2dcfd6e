#pragma once

// Recorded and rendered voices: what the editor reads of authors' files, and the FLAC that
// it makes of them.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "shared/core/status.h"

namespace lararium::bake {

struct Sound {
  int rate = 0;                // samples a second
  std::vector<float> samples;  // mono, -1..1

  double duration() const { return rate > 0 ? static_cast<double>(samples.size()) / rate : 0.0; }
};

// WAV, FLAC, Ogg (Vorbis, Opus) and whatever else libsndfile reads; channels are averaged.
// At most ten minutes, 8 to 192 kHz.
Result<Sound> ReadSound(const std::filesystem::path& file);
Result<Sound> ReadSound(std::span<const std::byte> bytes, const std::string& place);

// The bytes of a FLAC file of 16 bits. Deterministic, and exact to the sample, so that
// lips and voice agree wherever one jumps to.
Result<std::vector<std::byte>> WriteFlac(const Sound& sound);

// As loud as the others: the louder parts come to -20 dB below full scale (root mean
// square), peaks stay below -1 dB.
void Normalize(Sound& sound);

}  // namespace lararium::bake
