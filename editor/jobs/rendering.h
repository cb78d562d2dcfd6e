#pragma once

// Offline rendering: every frame of a recording, tracked and composited.

#include <cstdint>
#include <filesystem>
#include <vector>

#include "shared/core/log.h"
#include "shared/core/progress.h"
#include "shared/core/status.h"
#include "shared/show/show_content.h"

namespace lararium::editor {

struct RenderJob {
  show::ShowContent content;
  std::filesystem::path video;
  std::vector<double> intrinsics;  // 4 or 8 numbers; empty: those of the training.
  std::filesystem::path out;       // A file .mp4, with the show's sound mixed for headphones.
  std::filesystem::path sound;     // A file .wav; empty: none.
  bool evidence = false;           // Shows the colours of the evidence view.
};

struct RenderReport {
  int64_t frames = 0;
  int64_t tracked = 0;
};

// Renders off screen, in lock-step: the same job always gives the same picture. The file appears
// only when it is complete.
Result<RenderReport> RenderVideo(RenderJob job, Progress& progress, Log& log);

}  // namespace lararium::editor
