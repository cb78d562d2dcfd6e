#pragma once

// Sounds with known samples, as WAV files of 16 bits, for programs that browsers run.

#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "shared/audio/sound_graph.h"
#include "shared/core/random.h"

namespace lararium::test {

inline audio::SoundData Wav(const std::string& name,
                            uint16_t channels,
                            const std::vector<float>& samples) {
  auto bytes = std::make_shared<std::vector<std::byte>>();
  const auto put = [&](const void* data, size_t size) {
    const auto* begin = static_cast<const std::byte*>(data);
    bytes->insert(bytes->end(), begin, begin + size);
  };
  const auto put16 = [&](uint16_t value) { put(&value, 2); };
  const auto put32 = [&](uint32_t value) { put(&value, 4); };
  const auto size = static_cast<uint32_t>(2 * samples.size());
  put("RIFF", 4);
  put32(36 + size);
  put("WAVEfmt ", 8);
  put32(16);
  put16(1);
  put16(channels);
  put32(audio::SoundGraph::kRate);
  put32(2u * channels * audio::SoundGraph::kRate);
  put16(static_cast<uint16_t>(2 * channels));
  put16(16);
  put("data", 4);
  put32(size);
  for (const float sample : samples) {
    put16(static_cast<uint16_t>(std::lround(sample * 32767.0f)));
  }
  return {name, *bytes, bytes};
}

inline std::vector<float> WavNoise(double seconds) {
  Random random(11);
  std::vector<float> samples(static_cast<size_t>(seconds * audio::SoundGraph::kRate));
  for (float& sample : samples) {
    sample = static_cast<float>(random.Uniform(-0.25, 0.25));
  }
  return samples;
}

}  // namespace lararium::test
