#pragma once

// A sound device through OpenAL. Private to the room.

#include <memory>

#include "shared/audio/audio_out.h"
#include "shared/core/status.h"

namespace lararium::audio {

// Fails where there is none.
Result<std::unique_ptr<AudioOut>> OpenDeviceOut();

}  // namespace lararium::audio
