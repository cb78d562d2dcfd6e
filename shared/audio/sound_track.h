#pragma once

// The sound of a show for files: every sample once, in step with the drama's time.

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "shared/audio/mixer.h"
#include "shared/audio/sound_scene.h"

namespace lararium::audio {

class SoundTrack {
 public:
  using Take = std::function<Status(std::span<const float> stereo)>;

  // The first sample is that of the drama's beginning. take gets the samples, 48000
  // frames a second, piece by piece.
  static Result<std::unique_ptr<SoundTrack>> Create(std::shared_ptr<const SoundLibrary> library,
                                                    bool hrtf,
                                                    Take take);

  // Goes on with other sounds, whose indices later scenes mean, at the sample where it is.
  Status SetLibrary(std::shared_ptr<const SoundLibrary> library);

  // What was to be heard since the last call, until scene.frame_time. Going back gives nothing.
  // The same scenes give the same samples.
  Status RenderUntil(const SoundScene& scene);
  // The same scene for some seconds more, as the last picture is shown.
  Status RenderOn(double seconds);

 private:
  SoundTrack(bool hrtf, Take take)
      : hrtf_(hrtf), take_(std::move(take)), piece_(2 * kPieceFrames) {}

  static constexpr size_t kPieceFrames = 16 * Mixer::kBlockFrames;

  bool hrtf_;
  std::unique_ptr<Mixer> mixer_;  // set when created
  Take take_;
  SoundScene last_;
  int64_t frames_ = 0;  // that were rendered
  std::vector<float> piece_;
};

}  // namespace lararium::audio
