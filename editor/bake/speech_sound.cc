#include "editor/bake/speech_sound.h"

#include <sndfile.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <optional>

#include "editor/bake/libav_sound.h"
#include "shared/core/file.h"

namespace lararium::bake {
namespace {

constexpr int kLowestRate = 8000;
constexpr int kHighestRate = 192'000;
constexpr int kMaxChannels = 8;
constexpr double kMaxSeconds = 600.0;

// A file in memory, as libsndfile reads and writes it.
struct Memory {
  std::span<const std::byte> source;  // Bytes to read.
  std::vector<std::byte> written;
  sf_count_t at = 0;

  sf_count_t size() const {
    return static_cast<sf_count_t>(written.empty() ? source.size() : written.size());
  }
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

sf_count_t Write(const void* from, sf_count_t count, void* data) {
  Memory& memory = Of(data);
  const auto end = static_cast<size_t>(memory.at + count);
  if (memory.written.size() < end) {
    memory.written.resize(end);
  }
  std::memcpy(memory.written.data() + memory.at, from, static_cast<size_t>(count));
  memory.at += count;
  return count;
}

sf_count_t Tell(void* data) { return Of(data).at; }

SF_VIRTUAL_IO MemoryIo() { return {Length, Seek, Read, Write, Tell}; }

using SoundFile = std::unique_ptr<SNDFILE, decltype(&sf_close)>;

// Reads what libsndfile knows; nullopt: it does not know the container.
Result<std::optional<DecodedSound>> ReadWithSndfile(std::span<const std::byte> bytes,
                                                    const std::string& where) {
  Memory memory{bytes, {}, 0};
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

}  // namespace

Result<Sound> ReadSound(std::span<const std::byte> bytes, const std::string& where) {
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
  Sound sound;
  sound.rate = decoded->rate;
  const auto channels = static_cast<size_t>(decoded->channels);
  for (size_t i = 0; i + channels <= decoded->samples.size(); i += channels) {
    float sum = 0.0f;
    for (size_t c = 0; c < channels; ++c) {
      sum += decoded->samples[i + c];
    }
    const float mean = sum / static_cast<float>(channels);
    sound.samples.push_back(std::isfinite(mean) ? std::clamp(mean, -1.0f, 1.0f) : 0.0f);
  }
  return sound;
}

Result<Sound> ReadSound(const std::filesystem::path& file) {
  LARARIUM_ASSIGN_OR_RETURN(const std::vector<std::byte> bytes, ReadBytes(file));
  return ReadSound(bytes, file.string());
}

Result<std::vector<std::byte>> WriteFlac(const Sound& sound) {
  Memory memory;
  SF_VIRTUAL_IO io = MemoryIo();
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
  return std::move(memory.written);
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
