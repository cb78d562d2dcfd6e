#pragma once

// Records a run: the composite as a video with sound, the poses and the foreground.

#include <memory>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "player/app/options.h"
#include "shared/capture/frame_source.h"
#include "shared/capture/video_writer.h"
#include "shared/core/status.h"
#include "shared/render/gl/render_target.h"
#include "shared/show/show.h"
#include "shared/show/sound_recording.h"
#include "shared/vision/poses_file.h"

namespace lararium::player {

class Recorder {
 public:
  // Opens the files that the options ask for. source and options must outlive the object.
  // binaural: sound is mixed for headphones.
  static Result<Recorder> Create(const OutputOptions& options,
                                 const capture::FrameSource& source,
                                 const render::RenderTarget& target,
                                 const show::Show& show,
                                 bool binaural);

  // Continues with another show (show::Show::ResumeFrom).
  Status SetShow(const show::Show& show) { return sound_->SetShow(show); }

  // Adds the frame that target shows, and the sound up to it. If frames were dropped, the frame
  // before is repeated.
  Status Add(const show::StagedFrame& staged, const render::RenderTarget& target);
  // Completes the files and moves them to their final paths.
  Status Finish();

 private:
  Recorder(const OutputOptions& options, const capture::FrameSource& source)
      : options_(&options), source_(&source) {}

  const OutputOptions* options_;
  const capture::FrameSource* source_;
  std::unique_ptr<capture::VideoWriter> video_;
  std::optional<show::SoundRecording> sound_;  // always set by Create
  cv::Mat picture_;
  std::vector<vision::PoseRecord> poses_;
};

}  // namespace lararium::player
