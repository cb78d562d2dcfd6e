#pragma once

// All sounds of one show, by name. Short ones are decoded once, long ones while they play.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "shared/audio/sound_file.h"
#include "shared/core/status.h"

namespace lararium::audio {

// An encoded sound and the owner of its bytes.
struct SoundData {
  std::string name;
  std::span<const std::byte> bytes;
  std::shared_ptr<const void> owner;
};

struct Clip {
  std::string name;
  int rate = 0;
  int channels = 1;
  int64_t frames = 0;
  // The two channels have opposite phase, so that little is left of them in their sum. They must be
  // subtracted to be mixed to one.
  bool has_opposed_channels = false;
  std::vector<int16_t> samples;  // Interleaved; empty: `data` is decoded while it plays.
  SoundData data;                // Empty if `samples` are held.

  double seconds() const { return static_cast<double>(frames) / rate; }
};

// Immutable; may be shared by threads.
class SoundLibrary {
 public:
  // Longer sounds are streamed.
  static constexpr double kMaxHeldSeconds = 5.0;
  static constexpr size_t kMaxHeldSamples = size_t{48} << 20;  // Limit for all clips together.

  // Names must be unique. Errors name the sound.
  static Result<std::shared_ptr<const SoundLibrary>> Load(std::vector<SoundData> sounds);

  std::span<const Clip> clips() const { return clips_; }
  // Index of a clip; -1: there is no clip of that name.
  int Find(std::string_view name) const;

 private:
  SoundLibrary() = default;

  std::vector<Clip> clips_;  // Sorted by name.
};

}  // namespace lararium::audio
