#pragma once

// The moments of a recording's frames.

#include <cstdint>

namespace lararium::app {

// What rounding leaves of a frame's own moment, in frames.
inline constexpr double kSameFrame = 1e-6;

// So many frames further than the one that is shown at a time, or back: the very moment of that
// frame, seconds; below 0 before the first one. Not behind the last frame that begins within a
// duration, unless the time is already.
double TimeOfStep(double seconds, int64_t frames, double frames_per_second, double duration);

}  // namespace lararium::app
