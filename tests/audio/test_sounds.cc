#include "tests/audio/test_sounds.h"

#include <gtest/gtest.h>
#include <sndfile.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "shared/audio/sound_memory.h"
#include "shared/core/check.h"
#include "shared/core/random.h"

namespace lararium::test {
namespace {

int FormatOf(Coding coding) {
  switch (coding) {
    case Coding::kWav:
      return SF_FORMAT_WAV | SF_FORMAT_PCM_16;
    case Coding::kFlac:
      return SF_FORMAT_FLAC | SF_FORMAT_PCM_16;
    case Coding::kVorbis:
      return SF_FORMAT_OGG | SF_FORMAT_VORBIS;
    case Coding::kOpus:
      return SF_FORMAT_OGG | SF_FORMAT_OPUS;
  }
  return 0;
}

}  // namespace

std::vector<std::byte> Encode(std::span<const float> samples,
                              int channels,
                              int rate,
                              Coding coding) {
  audio::SoundMemory memory;
  SF_VIRTUAL_IO access = audio::SoundMemory::Io();
  SF_INFO info = {};
  info.samplerate = rate;
  info.channels = channels;
  info.format = FormatOf(coding);
  SNDFILE* file = sf_open_virtual(&access, SFM_WRITE, &info, &memory);
  CHECK(file != nullptr);
  const auto frames = static_cast<sf_count_t>(samples.size()) / channels;
  CHECK(sf_writef_float(file, samples.data(), frames) == frames);
  sf_close(file);
  return memory.bytes;
}

std::vector<float> Make(double seconds, const std::function<double(double)>& f, int rate) {
  std::vector<float> samples(static_cast<size_t>(std::llround(seconds * rate)));
  for (size_t i = 0; i < samples.size(); ++i) {
    samples[i] = static_cast<float>(f(static_cast<double>(i) / rate));
  }
  return samples;
}

std::vector<float> Tone(double seconds, double hertz, double level) {
  return Make(seconds,
              [=](double t) { return level * std::sin(2.0 * std::numbers::pi * hertz * t); });
}

std::vector<float> Noise(double seconds, double level) {
  Random random(11);
  return Make(seconds, [&](double) { return random.Uniform(-level, level); });
}

std::vector<float> Click(double seconds) {
  std::vector<float> samples(static_cast<size_t>(seconds * kRate));
  samples[0] = 0.5f;
  return samples;
}

audio::SoundData Sound(const std::string& name, std::vector<std::byte> bytes) {
  auto owner = std::make_shared<const std::vector<std::byte>>(std::move(bytes));
  return {name, *owner, owner};
}

std::shared_ptr<const audio::SoundLibrary> Library(std::vector<audio::SoundData> sounds) {
  auto library = audio::SoundLibrary::Load(std::move(sounds));
  EXPECT_TRUE(library.ok()) << library.message();
  return *library;
}

double Rms(std::span<const float> stereo, int ear, double from, double to) {
  const auto begin = static_cast<size_t>(from * kRate);
  const auto end = std::min(static_cast<size_t>(to * kRate), stereo.size() / 2);
  double sum = 0.0;
  for (size_t i = begin; i < end; ++i) {
    const double sample = stereo[2 * i + static_cast<size_t>(ear)];
    sum += sample * sample;
  }
  return std::sqrt(sum / static_cast<double>(std::max<size_t>(end - begin, 1)));
}

double Db(double ratio) { return 20.0 * std::log10(std::max(ratio, 1e-12)); }

int InterauralDelay(std::span<const float> stereo) {
  constexpr int kMost = 48;  // One millisecond.
  const int frames = static_cast<int>(stereo.size() / 2);
  int best = 0;
  double most = -1e300;
  for (int delay = -kMost; delay <= kMost; ++delay) {
    double sum = 0.0;
    for (int i = kMost; i + kMost < frames; ++i) {
      sum += static_cast<double>(stereo[static_cast<size_t>(2 * (i + delay))]) *
             static_cast<double>(stereo[static_cast<size_t>(2 * i + 1)]);
    }
    if (sum > most) {
      most = sum;
      best = delay;
    }
  }
  return best;
}

}  // namespace lararium::test
