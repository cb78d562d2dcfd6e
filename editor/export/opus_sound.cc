#include "editor/export/opus_sound.h"

#include <sndfile.h>

extern "C" {
#include <libavutil/channel_layout.h>
#include <libswresample/swresample.h>
}

#include <algorithm>
#include <cstring>
#include <memory>

#include "shared/audio/sound_file.h"
#include "shared/audio/sound_memory.h"

namespace lararium::exporter {
namespace {

constexpr int kVoiceRate = 24'000;  // Opus knows a few rates only.
constexpr int kOtherRate = 48'000;

struct Samples {
  int rate = 0;
  int channels = 0;
  std::vector<float> values;  // Interleaved.
};

Result<Samples> Decode(std::span<const std::byte> sound, const std::string& where) {
  LARARIUM_ASSIGN_OR_RETURN(audio::SoundReader reader, audio::SoundReader::Open(sound, where));
  const int channels = reader.channels();
  std::vector<int16_t> decoded(static_cast<size_t>(reader.frames() * channels));
  decoded.resize(reader.Read(decoded) * static_cast<size_t>(channels));
  Samples samples{
      reader.rate() <= kVoiceRate && channels == 1 ? kVoiceRate : kOtherRate, channels, {}};
  AVChannelLayout layout;
  av_channel_layout_default(&layout, channels);
  SwrContext* made = nullptr;
  int error = swr_alloc_set_opts2(&made, &layout, AV_SAMPLE_FMT_FLT, samples.rate, &layout,
                                  AV_SAMPLE_FMT_S16, reader.rate(), 0, nullptr);
  struct Free {
    void operator()(SwrContext* context) const { swr_free(&context); }
  };
  const std::unique_ptr<SwrContext, Free> converter(made);
  if (error < 0 || swr_init(made) < 0) {
    return Status::Error(where, "its rate cannot be converted", "give 44100 or 48000 a second");
  }
  const auto frames = static_cast<int>(decoded.size()) / channels;
  const auto wanted =
      static_cast<int>((int64_t{frames} * samples.rate + reader.rate() - 1) / reader.rate());
  samples.values.resize(static_cast<size_t>(wanted * channels));
  const auto* from = reinterpret_cast<const uint8_t*>(decoded.data());
  int written = 0;
  // A call without input gives what the resampler still holds.
  for (const uint8_t** input = &from; written < wanted; input = nullptr) {
    auto* to = reinterpret_cast<uint8_t*>(&samples.values[static_cast<size_t>(written * channels)]);
    const int count = swr_convert(made, &to, wanted - written, input, input ? frames : 0);
    if (count < 0 || (count == 0 && input == nullptr)) {
      break;
    }
    written += count;
  }
  return samples;
}

// Check sum of an Ogg page (RFC 3533, section 6).
uint32_t OggChecksum(std::span<const std::byte> page) {
  uint32_t sum = 0;
  for (const std::byte byte : page) {
    sum ^= std::to_integer<uint32_t>(byte) << 24;
    for (int bit = 0; bit < 8; ++bit) {
      sum = (sum << 1) ^ ((sum & 0x80000000u) != 0 ? 0x04c11db7u : 0u);
    }
  }
  return sum;
}

// libsndfile gives each stream a random serial number. With zero in its place, equal sounds are
// equal files.
void ClearSerialNumber(std::span<std::byte> file) {
  constexpr size_t kSerial = 14;
  constexpr size_t kChecksum = 22;
  constexpr size_t kSegments = 26;
  while (file.size() > kSegments) {
    const auto segments = std::to_integer<size_t>(file[kSegments]);
    size_t size = kSegments + 1 + segments;
    for (size_t i = 0; i < segments; ++i) {
      size += std::to_integer<size_t>(file[kSegments + 1 + i]);
    }
    const std::span<std::byte> page = file.first(size);
    std::memset(&page[kSerial], 0, 4);
    std::memset(&page[kChecksum], 0, 4);
    const uint32_t sum = OggChecksum(page);
    for (size_t i = 0; i < 4; ++i) {
      page[kChecksum + i] = static_cast<std::byte>(sum >> (8 * i));
    }
    file = file.subspan(size);
  }
}

}  // namespace

Result<std::vector<std::byte>> EncodeOpus(std::span<const std::byte> sound,
                                          const std::string& where) {
  LARARIUM_ASSIGN_OR_RETURN(const Samples samples, Decode(sound, where));
  audio::SoundMemory memory;
  SF_VIRTUAL_IO io = audio::SoundMemory::Io();
  SF_INFO info = {};
  info.samplerate = samples.rate;
  info.channels = samples.channels;
  info.format = SF_FORMAT_OGG | SF_FORMAT_OPUS;
  SNDFILE* file = sf_open_virtual(&io, SFM_WRITE, &info, &memory);
  if (file == nullptr) {
    return Status::Error(where, std::string("cannot be encoded: ") + sf_strerror(nullptr));
  }
  // libsndfile maps 0 to 256 kbit/s for each channel and 1 to 6.
  double level = samples.rate == kVoiceRate ? 0.896 : 0.768;
  sf_command(file, SFC_SET_COMPRESSION_LEVEL, &level, static_cast<int>(sizeof(level)));
  const auto frames = static_cast<sf_count_t>(samples.values.size()) / samples.channels;
  const bool written = sf_writef_float(file, samples.values.data(), frames) == frames;
  if (sf_close(file) != 0 || !written) {
    return Status::Error(where, "cannot be encoded");
  }
  ClearSerialNumber(memory.bytes);
  return std::move(memory.bytes);
}

}  // namespace lararium::exporter
