#pragma once

// A camera that may be unplugged. While it is disconnected its frames are black, and it is opened
// again as soon as it is back.

#include <functional>
#include <memory>
#include <string>

#include "shared/capture/frame_source.h"

namespace lararium::capture {

struct SteadyCameraOptions {
  double retry_seconds = 0.5;  // seconds between attempts to open the camera
  double black_rate = 10.0;    // Frames per second while the camera is disconnected.
  // Seconds without a jump after which the camera's clock is trusted again.
  double steady_clock = 2.0;
};

// The system functions that a steady camera uses; tests replace them.
struct SteadyCameraWorld {
  std::function<Result<std::unique_ptr<FrameSource>>()> open;
  std::function<double()> now;        // seconds, monotonic
  std::function<void(double)> sleep;  // seconds
  // Called on each change. `why` is the reason of a loss, and is given once if a camera came back
  // with another size.
  std::function<void(bool connected, const std::string& why)> changed;
  // Called when the camera's clock jumps by `leap` seconds, and when it has been steady for a
  // while. May be empty.
  std::function<void(bool steady, double leap)> clock_changed = {};
};

// camera: already open; its size stays fixed, and a camera of another size counts as disconnected.
// Frames are numbered continuously, and their capture times are seconds since the first call.
std::unique_ptr<FrameSource> MakeSteady(std::unique_ptr<FrameSource> camera,
                                        SteadyCameraWorld world,
                                        const SteadyCameraOptions& options = {});

// Returns the real system functions. `open` opens the camera.
SteadyCameraWorld RealWorld(std::function<Result<std::unique_ptr<FrameSource>>()> open,
                            std::function<void(bool, const std::string&)> changed,
                            std::function<void(bool, double)> clock_changed = {});

}  // namespace lararium::capture
