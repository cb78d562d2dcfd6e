#include "shared/audio/sound_track.h"

#include <algorithm>
#include <cmath>

namespace lararium::audio {

Result<std::unique_ptr<SoundTrack>> SoundTrack::Create(std::shared_ptr<const SoundLibrary> library,
                                                       bool hrtf,
                                                       Take take) {
  std::unique_ptr<SoundTrack> track(new SoundTrack(hrtf, std::move(take)));
  LARARIUM_RETURN_IF_ERROR(track->SetLibrary(std::move(library)));
  return track;
}

Status SoundTrack::SetLibrary(std::shared_ptr<const SoundLibrary> library) {
  MixerOptions options = MixerOptions::ForFiles();
  options.hrtf = hrtf_;
  LARARIUM_ASSIGN_OR_RETURN(mixer_, Mixer::Create(std::move(library), options));
  last_.voices.clear();
  return Status();
}

Status SoundTrack::RenderUntil(const SoundScene& scene) {
  last_ = scene;
  const auto end = static_cast<int64_t>(std::llround(scene.frame_time * Mixer::kRate));
  while (frames_ < end) {
    const auto count = static_cast<size_t>(std::min<int64_t>(end - frames_, int64_t{kPieceFrames}));
    const std::span<float> piece = std::span(piece_).first(2 * count);
    const double before_end = static_cast<double>(end - frames_) / Mixer::kRate;
    mixer_->Render(scene, scene.time - before_end, piece);
    LARARIUM_RETURN_IF_ERROR(take_(piece));
    frames_ += static_cast<int64_t>(count);
  }
  return Status();
}

Status SoundTrack::RenderOn(double seconds) {
  last_.time += seconds;
  last_.frame_time += seconds;
  return RenderUntil(SoundScene(last_));
}

}  // namespace lararium::audio
