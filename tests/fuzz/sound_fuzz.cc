// libFuzzer harness: opening and decoding any bytes as a sound terminates, and an accepted sound
// keeps to its limits.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "shared/audio/sound_file.h"
#include "shared/core/check.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using lararium::audio::SoundReader;
  auto reader = SoundReader::Open(std::as_bytes(std::span(data, size)), "fuzz");
  if (!reader.ok()) {
    CHECK(reader.message().starts_with("fuzz: "));
    return 0;
  }
  CHECK(reader->rate() >= SoundReader::kMinRate && reader->rate() <= SoundReader::kMaxRate);
  CHECK(reader->channels() == 1 || reader->channels() == 2);
  CHECK(reader->frames() > 0 && reader->seconds() <= SoundReader::kMaxSeconds);
  // Access like a mixer: a few pieces, a seek, a piece.
  std::vector<int16_t> piece(4096);
  for (int i = 0; i < 4; ++i) {
    CHECK(reader->Read(piece) <= piece.size() / static_cast<size_t>(reader->channels()));
  }
  if (reader->Seek(reader->frames() / 2)) {
    reader->Read(piece);
  }
  return 0;
}
