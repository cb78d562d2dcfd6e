#include "shared/audio/sound_file.h"

#include <sndfile.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <string_view>

namespace lararium::audio {
namespace {

constexpr size_t kPiece = 1024;  // Samples converted at a time.

// Bytes in memory as a file for libsndfile.
struct MemoryFile {
  std::span<const std::byte> bytes;
  sf_count_t position = 0;
};

sf_count_t Length(void* user) {
  return static_cast<sf_count_t>(static_cast<MemoryFile*>(user)->bytes.size());
}

sf_count_t SeekTo(sf_count_t offset, int whence, void* user) {
  auto* file = static_cast<MemoryFile*>(user);
  const auto size = static_cast<sf_count_t>(file->bytes.size());
  const sf_count_t base = whence == SEEK_SET ? 0 : whence == SEEK_CUR ? file->position : size;
  // Positions beyond the ends are clamped; the sum cannot overflow after the inner clamp.
  file->position =
      std::clamp<sf_count_t>(base + std::clamp<sf_count_t>(offset, -size, size), 0, size);
  return file->position;
}

sf_count_t ReadBytes(void* to, sf_count_t count, void* user) {
  auto* file = static_cast<MemoryFile*>(user);
  const auto left = static_cast<sf_count_t>(file->bytes.size()) - file->position;
  const sf_count_t read = std::clamp<sf_count_t>(count, 0, left);
  std::memcpy(to, file->bytes.data() + file->position, static_cast<size_t>(read));
  file->position += read;
  return read;
}

sf_count_t Write(const void* /*from*/, sf_count_t /*count*/, void* /*user*/) { return 0; }
sf_count_t Tell(void* user) { return static_cast<MemoryFile*>(user)->position; }

// Checks the first bytes; libsndfile knows many more formats than we want to trust.
bool LooksLikeSound(std::span<const std::byte> bytes) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()),
                              std::min<size_t>(bytes.size(), 12));
  return text.starts_with("fLaC") || text.starts_with("OggS") ||
         (text.size() == 12 && (text.starts_with("RIFF") || text.starts_with("RF64")) &&
          text.substr(8) == "WAVE");
}

bool IsFloat(int format) {
  const int coding = format & SF_FORMAT_SUBMASK;
  return coding == SF_FORMAT_FLOAT || coding == SF_FORMAT_DOUBLE;
}

// Files of floats may be louder than full scale, which would be clipped. The factor turns them
// down.
float GainOf(SNDFILE* sound, int format) {
  double peak = 0.0;
  if (!IsFloat(format) ||
      sf_command(sound, SFC_CALC_SIGNAL_MAX, &peak, static_cast<int>(sizeof(peak))) != 0) {
    return 1.0f;
  }
  return std::isfinite(peak) ? static_cast<float>(1.0 / std::max(peak, 1.0)) : 1.0f;
}

bool IsKnownFormat(int format) {
  const int kind = format & SF_FORMAT_TYPEMASK;
  const int coding = format & SF_FORMAT_SUBMASK;
  switch (kind) {
    case SF_FORMAT_WAV:
    case SF_FORMAT_WAVEX:
    case SF_FORMAT_RF64:
    case SF_FORMAT_FLAC:
      return coding == SF_FORMAT_PCM_S8 || coding == SF_FORMAT_PCM_U8 ||
             coding == SF_FORMAT_PCM_16 || coding == SF_FORMAT_PCM_24 ||
             coding == SF_FORMAT_PCM_32 || IsFloat(format);
    case SF_FORMAT_OGG:
      return coding == SF_FORMAT_VORBIS || coding == SF_FORMAT_OPUS;
    default:
      return false;
  }
}

int16_t ToSample(float value) {
  // NaN and infinity become silence.
  return value - value == 0.0f
             ? static_cast<int16_t>(std::lrint(std::clamp(value * 32768.0f, -32768.0f, 32767.0f)))
             : int16_t{0};
}

}  // namespace

struct SoundReader::File {
  MemoryFile memory;
  SNDFILE* sound = nullptr;
  float gain = 1.0f;

  ~File() {
    if (sound != nullptr) {
      sf_close(sound);
    }
  }
};

SoundReader::SoundReader(std::unique_ptr<File> file) : file_(std::move(file)) {}
SoundReader::SoundReader(SoundReader&&) noexcept = default;
SoundReader& SoundReader::operator=(SoundReader&&) noexcept = default;
SoundReader::~SoundReader() = default;

Result<SoundReader> SoundReader::Open(std::span<const std::byte> bytes, const std::string& where) {
  constexpr std::string_view kRemedy = "give WAV, FLAC, Ogg Vorbis or Ogg Opus";
  if (!LooksLikeSound(bytes)) {
    return Status::Error(where, "is not a sound file that can be played", kRemedy);
  }
  if (bytes.size() > kMaxBytes) {
    return Status::Error(where, "is larger than 512 MiB", "shorten or compress it");
  }
  auto file = std::make_unique<File>();
  file->memory.bytes = bytes;
  SF_VIRTUAL_IO access = {Length, SeekTo, ReadBytes, Write, Tell};
  SF_INFO info = {};
  file->sound = sf_open_virtual(&access, SFM_READ, &info, &file->memory);
  if (file->sound == nullptr) {
    return Status::Error(where, std::string("cannot be decoded: ") + sf_strerror(nullptr), kRemedy);
  }
  if (!IsKnownFormat(info.format)) {
    return Status::Error(where, "uses an encoding that is not supported", kRemedy);
  }
  if (info.channels < 1 || info.channels > kMaxChannels) {
    return Status::Error(where, "has " + std::to_string(info.channels) + " channels",
                         "give one or two");
  }
  if (info.samplerate < kMinRate || info.samplerate > kMaxRate) {
    return Status::Error(where, "has " + std::to_string(info.samplerate) + " samples a second",
                         "give 8000 to 192000");
  }
  if (info.frames < 1 || info.frames > kMaxSeconds * info.samplerate) {
    return Status::Error(where, "is empty, or longer than an hour");
  }
  if (info.seekable == 0) {
    return Status::Error(where, "is damaged: it cannot be played from the middle");
  }
  file->gain = GainOf(file->sound, info.format);
  SoundReader reader(std::move(file));
  reader.rate_ = info.samplerate;
  reader.channels_ = info.channels;
  reader.frames_ = info.frames;
  return reader;
}

bool SoundReader::Seek(int64_t frame) {
  return sf_seek(file_->sound, std::clamp<int64_t>(frame, 0, frames_), SEEK_SET) == frame;
}

size_t SoundReader::Read(std::span<int16_t> samples) {
  const auto channels = static_cast<size_t>(channels_);
  std::array<float, kPiece> piece;
  size_t done = 0;  // samples
  while (done + channels <= samples.size()) {
    const size_t wanted = std::min(kPiece, samples.size() - done) / channels;
    const sf_count_t read =
        sf_readf_float(file_->sound, piece.data(), static_cast<sf_count_t>(wanted));
    if (read <= 0) {
      break;
    }
    const size_t count = static_cast<size_t>(read) * channels;
    std::transform(piece.begin(), piece.begin() + static_cast<std::ptrdiff_t>(count),
                   samples.begin() + static_cast<std::ptrdiff_t>(done),
                   [gain = file_->gain](float value) { return ToSample(gain * value); });
    done += count;
  }
  return done / channels;
}

}  // namespace lararium::audio
