#pragma once

// A sound device through OpenAL. Private to shared/audio.

#include <memory>

#include "shared/audio/audio_out.h"
#include "shared/core/status.h"

namespace lararium::audio {

// Fails if there is no device.
Result<std::unique_ptr<AudioOut>> OpenDeviceOut();

}  // namespace lararium::audio
