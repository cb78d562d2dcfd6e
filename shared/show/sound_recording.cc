#include "shared/show/sound_recording.h"

#include <span>

namespace lararium::show {

Result<SoundRecording> SoundRecording::Create(const Show& show,
                                              bool hrtf,
                                              capture::VideoWriter* video,
                                              const std::filesystem::path& file) {
  SoundRecording recording;
  if (!Sounds(show)) {
    video = nullptr;
  }
  if (!file.empty()) {
    LARARIUM_ASSIGN_OR_RETURN(recording.file_,
                              audio::CreateAudioOut(audio::AudioOutKind::kFile, file));
  }
  if (video == nullptr && recording.file_ == nullptr) {
    return recording;
  }
  const auto take = [video, out = recording.file_.get()](std::span<const float> stereo) {
    if (video != nullptr) {
      LARARIUM_RETURN_IF_ERROR(video->WriteSound(stereo));
    }
    return out != nullptr ? out->Write(stereo) : Status();
  };
  LARARIUM_ASSIGN_OR_RETURN(recording.track_, audio::SoundTrack::Create(show.sounds(), hrtf, take));
  return recording;
}

Status SoundRecording::SetShow(const Show& show) {
  return track_ != nullptr ? track_->SetLibrary(show.sounds()) : Status();
}

Status SoundRecording::Add(const audio::SoundScene& scene) {
  return track_ != nullptr ? track_->RenderUntil(scene) : Status();
}

Status SoundRecording::Finish(double last_seconds) {
  if (track_ != nullptr) {
    LARARIUM_RETURN_IF_ERROR(track_->RenderOn(last_seconds));
  }
  return file_ != nullptr ? file_->Finish() : Status();
}

}  // namespace lararium::show
