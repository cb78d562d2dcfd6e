#pragma once

// A camera that may be unplugged: while it is away its frames are black, and it is opened again
// as soon as it is back.

#include <functional>
#include <memory>
#include <string>

#include "shared/capture/frame_source.h"

namespace lararium::capture {

struct SteadyCameraOptions {
  double retry_seconds = 0.5;  // between attempts to open it
  double black_rate = 10.0;    // frames per second while it is away
  double steady_clock = 2.0;   // seconds without a leap after which its clock is believed again
};

// What it needs of the world: doubles stand in for it in tests.
struct SteadyCameraWorld {
  std::function<Result<std::unique_ptr<FrameSource>>()> open;
  std::function<double()> now;        // seconds, monotonic
  std::function<void(double)> sleep;  // seconds
  // Told of each change; why: of a loss, and once of a camera that came back with another size.
  std::function<void(bool connected, const std::string& why)> changed;
  // Told when the camera's clock leaps, by so many seconds, and when it has not for a while; may be
  // empty.
  std::function<void(bool steady, double leap)> clock_changed = {};
};

// camera: opened already, for its size, which stays: a camera of another size counts as none.
// Frames are numbered through, and their capture times are seconds since the first call.
std::unique_ptr<FrameSource> MakeSteady(std::unique_ptr<FrameSource> camera,
                                        SteadyCameraWorld world,
                                        const SteadyCameraOptions& options = {});

// The world itself. open: of the camera.
SteadyCameraWorld RealWorld(std::function<Result<std::unique_ptr<FrameSource>>()> open,
                            std::function<void(bool, const std::string&)> changed,
                            std::function<void(bool, double)> clock_changed = {});

}  // namespace lararium::capture
