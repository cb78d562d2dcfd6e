#include "editor/bake/speech_sound.h"

#include <sndfile.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <functional>
#include <memory>
#include <numeric>
#include <optional>
#include <utility>

#include "editor/bake/libav_sound.h"
#include "editor/bake/recording.h"
#include "shared/audio/sound_memory.h"
#include "shared/core/file.h"

namespace lararium::bake {
namespace {

constexpr int kLowestRate = 8000;
constexpr int kHighestRate = 192'000;
constexpr int kMaxChannels = 8;
constexpr double kMaxSeconds = 600.0;

// A file in memory, as libsndfile reads it.
struct Memory {
  std::span<const std::byte> source;
  sf_count_t at = 0;

  sf_count_t size() const { return static_cast<sf_count_t>(source.size()); }
};

Memory& Of(void* data) { return *static_cast<Memory*>(data); }

sf_count_t Length(void* data) { return Of(data).size(); }

sf_count_t Seek(sf_count_t offset, int whence, void* data) {
  Memory& memory = Of(data);
  const sf_count_t from = whence == SEEK_SET ? 0 : whence == SEEK_CUR ? memory.at : memory.size();
  memory.at = std::clamp<sf_count_t>(from + offset, 0, memory.size());
  return memory.at;
}

sf_count_t Read(void* to, sf_count_t count, void* data) {
  Memory& memory = Of(data);
  count =
      std::clamp<sf_count_t>(count, 0, static_cast<sf_count_t>(memory.source.size()) - memory.at);
  std::memcpy(to, memory.source.data() + memory.at, static_cast<size_t>(count));
  memory.at += count;
  return count;
}

sf_count_t WriteNothing(const void*, sf_count_t, void*) { return 0; }

sf_count_t Tell(void* data) { return Of(data).at; }

SF_VIRTUAL_IO MemoryIo() { return {Length, Seek, Read, WriteNothing, Tell}; }

using SoundFile = std::unique_ptr<SNDFILE, decltype(&sf_close)>;

// Reads what libsndfile knows; nullopt: it does not know the container.
Result<std::optional<DecodedSound>> ReadWithSndfile(std::span<const std::byte> bytes,
                                                    const std::string& where) {
  Memory memory{bytes};
  SF_VIRTUAL_IO io = MemoryIo();
  SF_INFO info = {};
  const SoundFile file(sf_open_virtual(&io, SFM_READ, &info, &memory), sf_close);
  if (file == nullptr) {
    return std::optional<DecodedSound>();
  }
  DecodedSound sound{info.samplerate, info.channels, {}};
  const auto longest = static_cast<size_t>(kMaxSeconds * info.samplerate * info.channels);
  constexpr sf_count_t kBlock = 16384;  // frames
  std::vector<float> block(static_cast<size_t>(kBlock * std::max(info.channels, 1)));
  // The count in the header is not trusted; read to the end of the data.
  for (sf_count_t frames = kBlock; frames == kBlock;) {
    frames = sf_readf_float(file.get(), block.data(), kBlock);
    sound.samples.insert(sound.samples.end(), block.begin(),
                         block.begin() + std::max<sf_count_t>(frames, 0) * info.channels);
    if (sound.samples.size() > longest) {
      return Status::Error(where, "lasts longer than ten minutes", "cut it to the line");
    }
  }
  return std::optional(std::move(sound));
}

double Power(std::span<const float> samples) {
  return std::transform_reduce(samples.begin(), samples.end(), 0.0, std::plus<>(),
                               [](float x) { return static_cast<double>(x) * x; });
}

// Averages the channels. That weakens a voice which is on one of several channels (a microphone on
// the left, a field recorder), and removes one whose channels have opposite signs (a cable with
// swapped wires): the loudest channel is taken instead.
void MixDown(const DecodedSound& decoded,
             const std::string& where,
             Sound& sound,
             std::vector<std::string>& notes) {
  // Shares of the loudest channel's power. The mean of two unrelated channels has 0.5.
  constexpr double kWeak = 0.4;
  constexpr double kSilent = 0.001;
  const auto count = static_cast<size_t>(decoded.channels);
  std::vector<std::vector<float>> channels(count);
  for (size_t i = 0; i + count <= decoded.samples.size(); i += count) {
    double sum = 0.0;
    for (size_t c = 0; c < count; ++c) {
      const float value = decoded.samples[i + c];
      channels[c].push_back(std::isfinite(value) ? value : 0.0f);
      sum += channels[c].back();
    }
    sound.samples.push_back(static_cast<float>(sum / static_cast<double>(count)));
  }
  std::vector<double> powers;
  for (const std::vector<float>& channel : channels) {
    powers.push_back(Power(channel));
  }
  const auto loudest = std::max_element(powers.begin(), powers.end());
  if (Power(sound.samples) >= kWeak * *loudest) {
    return;
  }
  const auto index = static_cast<size_t>(loudest - powers.begin());
  sound.samples = std::move(channels[index]);
  if (std::count_if(powers.begin(), powers.end(),
                    [&](double power) { return power > kSilent * *loudest; }) > 1) {
    notes.push_back(where + ": its " + std::to_string(count) +
                    " channels weaken each other when they are mixed; channel " +
                    std::to_string(index + 1) + ", the loudest, is used alone");
  }
}

// Decoders of compressed sounds overshoot a little, which is not worth a note.
void LimitPeak(const std::string& where, Sound& sound, std::vector<std::string>& notes) {
  constexpr double kOvershootDb = 1.0;
  float peak = 1.0f;
  for (const float sample : sound.samples) {
    peak = std::max(peak, std::abs(sample));
  }
  for (float& sample : sound.samples) {
    sample /= peak;
  }
  if (const double db = 20.0 * std::log10(static_cast<double>(peak)); db > kOvershootDb) {
    std::array<char, 96> text = {};
    std::snprintf(text.data(), text.size(),
                  ": is %.0f dB louder than full scale; it was turned down by that", db);
    notes.push_back(where + text.data());
  }
}

}  // namespace

Result<Sound> ReadRecording(std::span<const std::byte> bytes,
                            const std::string& where,
                            std::vector<std::string>& notes) {
  LARARIUM_ASSIGN_OR_RETURN(std::optional<DecodedSound> decoded, ReadWithSndfile(bytes, where));
  if (!decoded || decoded->samples.empty()) {
    LARARIUM_ASSIGN_OR_RETURN(decoded, DecodeWithLibav(bytes, where, kMaxSeconds));
  }
  if (decoded->samples.empty()) {
    return Status::Error(where, "contains no sound", "record the line again");
  }
  if (decoded->rate < kLowestRate || decoded->rate > kHighestRate || decoded->channels < 1 ||
      decoded->channels > kMaxChannels) {
    return Status::Error(where, "must have 8 to 192 thousand samples a second and 1 to 8 channels");
  }
  Sound sound{decoded->rate, {}};
  MixDown(*decoded, where, sound, notes);
  LimitPeak(where, sound, notes);
  return sound;
}

Result<Sound> ReadRecording(const std::filesystem::path& file, std::vector<std::string>& notes) {
  LARARIUM_ASSIGN_OR_RETURN(const std::vector<std::byte> bytes, ReadBytes(file));
  return ReadRecording(bytes, file.string(), notes);
}

Result<Sound> ReadSound(std::span<const std::byte> bytes, const std::string& where) {
  std::vector<std::string> ignored;
  return ReadRecording(bytes, where, ignored);
}

Result<Sound> ReadSound(const std::filesystem::path& file) {
  std::vector<std::string> ignored;
  return ReadRecording(file, ignored);
}

Result<std::vector<std::byte>> WriteFlac(const Sound& sound) {
  audio::SoundMemory memory;
  SF_VIRTUAL_IO io = audio::SoundMemory::Io();
  SF_INFO info = {};
  info.samplerate = sound.rate;
  info.channels = 1;
  info.format = SF_FORMAT_FLAC | SF_FORMAT_PCM_16;
  SoundFile file(sf_open_virtual(&io, SFM_WRITE, &info, &memory), sf_close);
  if (file == nullptr) {
    return Status::Error("FLAC", sf_strerror(nullptr));
  }
  std::vector<short> samples;
  samples.reserve(sound.samples.size());
  for (const float sample : sound.samples) {
    samples.push_back(static_cast<short>(std::lround(std::clamp(sample, -1.0f, 1.0f) * 32767.0f)));
  }
  const auto count = static_cast<sf_count_t>(samples.size());
  const bool written = sf_writef_short(file.get(), samples.data(), count) == count;
  file.reset();
  if (!written) {
    return Status::Error("FLAC", "the sound could not be written");
  }
  return std::move(memory.bytes);
}

void Normalize(Sound& sound) {
  constexpr float kLevel = 0.1f;   // -20 dB
  constexpr float kPeak = 0.891f;  // -1 dB
  constexpr float kQuiet = 0.01f;  // Parts below -40 dB of the peak are pauses.
  const size_t window = std::max<size_t>(static_cast<size_t>(sound.rate) / 50, 1);
  float peak = 0.0f;
  for (const float sample : sound.samples) {
    peak = std::max(peak, std::abs(sample));
  }
  double power = 0.0;
  size_t count = 0;
  for (size_t begin = 0; begin + window <= sound.samples.size(); begin += window) {
    double sum = 0.0;
    for (size_t i = begin; i < begin + window; ++i) {
      sum += static_cast<double>(sound.samples[i]) * static_cast<double>(sound.samples[i]);
    }
    if (std::sqrt(sum / static_cast<double>(window)) > static_cast<double>(kQuiet * peak)) {
      power += sum;
      count += window;
    }
  }
  if (peak <= 0.0f || count == 0) {
    return;
  }
  const auto level = static_cast<float>(std::sqrt(power / static_cast<double>(count)));
  const float gain = std::min(kLevel / level, kPeak / peak);
  for (float& sample : sound.samples) {
    sample *= gain;
  }
}

}  // namespace lararium::bake
