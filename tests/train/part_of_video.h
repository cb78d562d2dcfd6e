#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "shared/capture/frame_source.h"

namespace lararium::train {

// Every step-th frame of a video, from first to last.
struct Part {
  std::filesystem::path video;
  int64_t first = 0;
  int64_t last = 0;
  int64_t step = 1;

  std::unique_ptr<capture::FrameSource> Open() const;
};

}  // namespace lararium::train
