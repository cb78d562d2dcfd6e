#pragma once

// A recording that restarts at its end: for kiosks without a camera, and for long tests.

#include <memory>

#include "shared/capture/frame_source.h"

namespace lararium::capture {

// Frame numbers and times continue from round to round. A recording without any frame ends at once.
// Seek() goes to the first round.
std::unique_ptr<FrameSource> Loop(std::unique_ptr<FrameSource> recording);

}  // namespace lararium::capture
