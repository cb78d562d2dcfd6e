#include "player/recorder.h"

namespace lararium::player {

Result<Recorder> Recorder::Create(const PlayOptions& options,
                                  const capture::FrameSource& source,
                                  const render::RenderTarget& target) {
  Recorder recorder(options, source);
  if (!options.record.empty()) {
    LARARIUM_ASSIGN_OR_RETURN(
        recorder.video_, capture::VideoWriter::Create(options.record, target.width(),
                                                      target.height(), source.frames_per_second()));
  }
  return recorder;
}

Status Recorder::Add(const vision::TrackedFrame& tracked, const render::RenderTarget& target) {
  if (!options_->poses_out.empty()) {
    poses_.push_back(vision::MakePoseRecord(source_->FrameName(tracked.frame.index), tracked));
  }
  if (video_ != nullptr) {
    target.ReadPixels(picture_);
    return video_->Write(picture_);
  }
  return Status();
}

Status Recorder::Finish() {
  if (!options_->poses_out.empty()) {
    LARARIUM_RETURN_IF_ERROR(vision::SavePoses(options_->poses_out, poses_));
  }
  return video_ != nullptr ? video_->Finish() : Status();
}

}  // namespace lararium::player
