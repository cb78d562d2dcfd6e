#pragma once

// The times of a recording's frames.

#include <cstdint>

namespace lararium::editor {

// Tolerance for rounding in a frame's time, in frames.
inline constexpr double kSameFrame = 1e-6;

// The time, in seconds, of the frame that lies a number of frames after (frames > 0) or before the
// frame shown at a given time. The result can be below 0. It does not exceed the last frame that
// begins within duration, unless seconds already does.
double TimeOfStep(double seconds, int64_t frames, double frames_per_second, double duration);

}  // namespace lararium::editor
