#pragma once

// What a run leaves behind: the composite as a video with its sound, and the poses.

#include <filesystem>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "player/options.h"
#include "shared/capture/frame_source.h"
#include "shared/capture/video_writer.h"
#include "shared/core/status.h"
#include "shared/render/render_target.h"
#include "shared/show/show.h"
#include "shared/show/sound_recording.h"
#include "shared/vision/poses_file.h"

namespace lararium::player {

class Recorder {
 public:
  // Opens what the options ask for. source and options must outlive it.
  static Result<Recorder> Create(const PlayOptions& options,
                                 const capture::FrameSource& source,
                                 const render::RenderTarget& target,
                                 const show::Show& show);

  // Goes on with another show (show::Show::GoOnFrom).
  Status SetShow(const show::Show& show) { return sound_->SetShow(show); }

  // The frame that target shows, and what is heard until it. Where frames were dropped the
  // one before is shown for longer.
  Status Add(const show::StagedFrame& staged, const render::RenderTarget& target);
  // Puts the files in their places.
  Status Finish();

 private:
  Recorder(const PlayOptions& options, const capture::FrameSource& source)
      : options_(&options), source_(&source) {}

  const PlayOptions* options_;
  const capture::FrameSource* source_;
  std::unique_ptr<capture::VideoWriter> video_;
  int64_t video_index_ = -1;                   // of the last frame
  std::optional<show::SoundRecording> sound_;  // set when created
  cv::Mat picture_;
  std::vector<vision::PoseRecord> poses_;
};

}  // namespace lararium::player
