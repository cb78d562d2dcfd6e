#pragma once

// Recorded and rendered voices: reads the sound files of authors and writes FLAC.

#include <cstddef>
#include <filesystem>
#include <span>
#include <vector>

#include "shared/core/status.h"

namespace lararium::bake {

struct Sound {
  int rate = 0;                // Samples per second.
  std::vector<float> samples;  // Mono, -1..1.

  double duration() const { return rate > 0 ? static_cast<double>(samples.size()) / rate : 0.0; }
};

// Reads WAV, FLAC, Ogg (Vorbis, Opus) and the other formats of libsndfile, then those of libav
// (M4A, MP4, WMA). Gives one channel of at most full scale; ReadRecording() says how. Accepts at
// most ten minutes at 8 to 192 kHz.
Result<Sound> ReadSound(const std::filesystem::path& file);
Result<Sound> ReadSound(std::span<const std::byte> bytes, const std::string& where);

// The bytes of a FLAC file of 16 bits. Deterministic and exact to the sample, so that lips and
// voice stay together after a seek to any time.
Result<std::vector<std::byte>> WriteFlac(const Sound& sound);

// Normalises the loudness: brings the louder parts to -20 dB below full scale (RMS) and keeps
// peaks below -1 dB.
void Normalize(Sound& sound);

}  // namespace lararium::bake
