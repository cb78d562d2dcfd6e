#include "player/app/recorder.h"

#include <algorithm>
#include <cmath>

namespace lararium::player {

Result<Recorder> Recorder::Create(const OutputOptions& options,
                                  const capture::FrameSource& source,
                                  const render::RenderTarget& target,
                                  const show::Show& show,
                                  bool binaural) {
  Recorder recorder(options, source);
  if (!options.record.empty()) {
    LARARIUM_ASSIGN_OR_RETURN(
        recorder.video_, capture::VideoWriter::Create(options.record, target.width(),
                                                      target.height(), source.frames_per_second(),
                                                      show::SoundRecording::Sounds(show)));
  }
  LARARIUM_ASSIGN_OR_RETURN(
      recorder.sound_,
      show::SoundRecording::Create(show, binaural, recorder.video_.get(), options.sound));
  return recorder;
}

Status Recorder::Add(const show::StagedFrame& staged, const render::RenderTarget& target) {
  const vision::TrackedFrame& tracked = staged.tracked;
  if (!options_->poses.empty()) {
    poses_.push_back(vision::MakePoseRecord(source_->FrameName(tracked.frame.index), tracked));
  }
  LARARIUM_RETURN_IF_ERROR(sound_->Add(staged.sound));
  if (video_ != nullptr) {
    target.ReadPixels(picture_);
    const auto index =
        static_cast<int64_t>(std::llround(staged.sound.frame_time * source_->frames_per_second()));
    video_index_ = std::max(index, video_index_ + 1);
    return video_->Write(picture_, video_index_);
  }
  return Status();
}

Status Recorder::Finish() {
  if (!options_->poses.empty()) {
    LARARIUM_RETURN_IF_ERROR(vision::SavePoses(options_->poses, poses_));
  }
  LARARIUM_RETURN_IF_ERROR(sound_->Finish(1.0 / source_->frames_per_second()));
  return video_ != nullptr ? video_->Finish() : Status();
}

}  // namespace lararium::player
