#pragma once

// Sounds with known samples, and measurements of sounds.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "shared/audio/sound_library.h"

namespace lararium::test {

inline constexpr int kRate = 48'000;

enum class Coding { kWav, kFlac, kVorbis, kOpus };

// Encodes interleaved samples, -1 to 1, as a file.
std::vector<std::byte> Encode(std::span<const float> samples,
                              int channels,
                              int rate = kRate,
                              Coding coding = Coding::kWav);

// Samples f(seconds) for a duration of `seconds`.
std::vector<float> Make(double seconds, const std::function<double(double)>& f, int rate = kRate);
std::vector<float> Tone(double seconds, double hertz, double level = 0.25);
// Uniform noise with a fixed seed.
std::vector<float> Noise(double seconds, double level = 0.25);
// A single sample of level 0.5 followed by silence.
std::vector<float> Click(double seconds);

audio::SoundData Sound(const std::string& name, std::vector<std::byte> bytes);
std::shared_ptr<const audio::SoundLibrary> Library(std::vector<audio::SoundData> sounds);

// Root mean square of one ear (0: left) within [from, to) seconds.
double Rms(std::span<const float> stereo, int ear, double from, double to);
double Db(double ratio);
// Delay of the left ear against the right one, in samples.
int InterauralDelay(std::span<const float> stereo);

}  // namespace lararium::test
