#include "player/app/recorder.h"

#include "shared/image/encode.h"
#include "shared/vision/foreground/foreground_mask.h"

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
  if (!options_->foreground.empty()) {
    cv::Mat opacity = vision::ForegroundOpacity(tracked);
    if (opacity.empty()) {
      opacity = cv::Mat::zeros(tracked.frame.bgr.size(), CV_8UC1);
    }
    const std::filesystem::path name = source_->FrameName(tracked.frame.index);
    LARARIUM_RETURN_IF_ERROR(image::WriteImage(
        options_->foreground / name.filename().replace_extension(".png"), opacity));
  }
  LARARIUM_RETURN_IF_ERROR(sound_->Add(staged.sound));
  if (video_ != nullptr) {
    target.ReadPixels(picture_);
    return video_->Write(picture_, staged.sound.frame_time);
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
