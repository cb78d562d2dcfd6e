#pragma once

// Decodes sound files in memory: WAV, FLAC, and Ogg with Vorbis or Opus, by libsndfile.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "shared/core/status.h"

namespace lararium::audio {

// Decodes one sound piece by piece. Borrows the bytes. Not thread-safe.
class SoundReader {
 public:
  static constexpr int kMinRate = 8'000;
  static constexpr int kMaxRate = 192'000;
  static constexpr int kMaxChannels = 2;
  static constexpr int64_t kMaxSeconds = 3600;
  static constexpr size_t kMaxBytes = size_t{1} << 29;

  // Reads only the header. Rejects other formats before any library sees them, and sounds beyond
  // the limits above. where: where errors happened, for example a file name.
  static Result<SoundReader> Open(std::span<const std::byte> bytes, const std::string& where);
  SoundReader(SoundReader&&) noexcept;
  SoundReader& operator=(SoundReader&&) noexcept;
  ~SoundReader();

  int rate() const { return rate_; }          // Samples per second.
  int channels() const { return channels_; }  // 1 or 2
  int64_t frames() const { return frames_; }  // Samples per channel.
  double seconds() const { return static_cast<double>(frames_) / rate_; }

  // Sets the next frame to read. Returns false if the file is damaged.
  bool Seek(int64_t frame);
  // Reads interleaved samples. Returns the number of frames read; it is smaller only at the end, or
  // if the file is damaged.
  size_t Read(std::span<int16_t> samples);

 private:
  struct File;
  explicit SoundReader(std::unique_ptr<File> file);

  std::unique_ptr<File> file_;
  int rate_ = 0;
  int channels_ = 0;
  int64_t frames_ = 0;
};

}  // namespace lararium::audio
