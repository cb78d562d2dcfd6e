#pragma once

// Output of mixed samples: a sound device, a file, or none.

#include <filesystem>
#include <memory>
#include <span>
#include <string>

#include "shared/core/status.h"

namespace lararium::audio {

class AudioOut {
 public:
  virtual ~AudioOut() = default;

  // Writes the next samples: left, right, ..., 48000 frames a second. A device blocks until it has
  // accepted them; a file accepts them at once. Returns an error if the device was lost or the disk
  // is full.
  virtual Status Write(std::span<const float> stereo) = 0;
  // Seconds until samples that are written now are heard.
  virtual double latency() const = 0;
  // Completes the output. Do not write afterwards.
  virtual Status Finish() = 0;
  virtual std::string name() const = 0;
};

enum class AudioOutKind {
  kDevice,  // OpenAL's default device.
  kFile,    // WAV, 16 bits; gets its final name when it is finished.
  kNone,    // Discards samples at the rate of a device.
};

// file: used by kFile only.
Result<std::unique_ptr<AudioOut>> CreateAudioOut(AudioOutKind kind,
                                                 const std::filesystem::path& file = {});

}  // namespace lararium::audio
