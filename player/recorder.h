#pragma once

// What a run leaves behind: the composite as a video, and the poses.

#include <filesystem>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "player/options.h"
#include "shared/capture/frame_source.h"
#include "shared/capture/video_writer.h"
#include "shared/core/status.h"
#include "shared/render/render_target.h"
#include "shared/vision/poses_file.h"
#include "shared/vision/tracked_frame.h"

namespace lararium::player {

class Recorder {
 public:
  // Opens what the options ask for. source and options must outlive it.
  static Result<Recorder> Create(const PlayOptions& options,
                                 const capture::FrameSource& source,
                                 const render::RenderTarget& target);

  // The frame that target shows.
  Status Add(const vision::TrackedFrame& tracked, const render::RenderTarget& target);
  // Puts the files in their places.
  Status Finish();

 private:
  Recorder(const PlayOptions& options, const capture::FrameSource& source)
      : options_(&options), source_(&source) {}

  const PlayOptions* options_;
  const capture::FrameSource* source_;
  std::unique_ptr<capture::VideoWriter> video_;
  cv::Mat picture_;
  std::vector<vision::PoseRecord> poses_;
};

}  // namespace lararium::player
