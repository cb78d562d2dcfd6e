#pragma once

// Where mixed samples go: a sound device, a file, or nowhere.

#include <filesystem>
#include <memory>
#include <span>
#include <string>

#include "shared/core/status.h"

namespace lararium::audio {

class AudioOut {
 public:
  virtual ~AudioOut() = default;

  // The next samples: left, right, ..., 48000 frames a second. Waits until they are
  // taken: as they are played; a file takes them at once. An error: it is lost, or full.
  virtual Status Write(std::span<const float> stereo) = 0;
  // Seconds until what is written now is heard.
  virtual double latency() const = 0;
  // Completes what was begun. Nothing may be written afterwards.
  virtual Status Finish() = 0;
  virtual std::string name() const = 0;
};

enum class AudioOutKind {
  kDevice,  // OpenAL's default device
  kFile,    // WAV, 16 bits; appears under its name when it is finished
  kNone,    // takes samples at the pace at which a device would
};

// file: of kFile.
Result<std::unique_ptr<AudioOut>> CreateAudioOut(AudioOutKind kind,
                                                 const std::filesystem::path& file = {});

}  // namespace lararium::audio
