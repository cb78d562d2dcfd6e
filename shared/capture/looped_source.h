#pragma once

// A recording that begins again at its end: for kiosks that have no camera, and long tests.

#include <memory>

#include "shared/capture/frame_source.h"

namespace lararium::capture {

// Frames are numbered through, and time goes on from round to round. A recording without a single
// frame ends at once. Seeking leads into the first round.
std::unique_ptr<FrameSource> Loop(std::unique_ptr<FrameSource> recording);

}  // namespace lararium::capture
