#pragma once

// The offline composite: every frame of a recording, tracked and drawn over.

#include <cstdint>
#include <filesystem>
#include <vector>

#include "shared/core/log.h"
#include "shared/core/progress.h"
#include "shared/core/status.h"
#include "shared/show/show_content.h"

namespace lararium::app {

struct RenderJob {
  show::ShowContent content;
  std::filesystem::path video;
  std::vector<double> intrinsics;  // 4 or 8 numbers, or empty: those of the training
  std::filesystem::path out;       // .mp4, with the show's sound as headphones want it
  std::filesystem::path sound;     // .wav; empty: none
  bool evidence = false;           // in the colours of how certain things are
};

struct RenderReport {
  int64_t frames = 0;
  int64_t tracked = 0;
};

// Off screen, in lock-step: the same job gives the same picture. The file
// appears only when it is complete.
Result<RenderReport> RenderVideo(RenderJob job, Progress& progress, Log& log);

}  // namespace lararium::app
