#include "editor/document/frame_times.h"

#include <algorithm>
#include <cmath>

namespace lararium::editor {

double TimeOfStep(double seconds, int64_t frames, double frames_per_second, double duration) {
  const double frame =
      std::floor(seconds * frames_per_second + kSameFrame) + static_cast<double>(frames);
  return std::min(frame / frames_per_second, std::max(duration - 1.0 / frames_per_second, seconds));
}

}  // namespace lararium::editor
