#pragma once

// The sound of a show for files: every sample once, synchronous with the drama's time.

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

  // The first sample is at the drama's beginning. `take` receives the samples piece by piece, 48000
  // frames a second.
  static Result<std::unique_ptr<SoundTrack>> Create(std::shared_ptr<const SoundLibrary> library,
                                                    bool hrtf,
                                                    Take take);

  // Continues with another library at the present sample; later scenes refer to its indices.
  Status SetLibrary(std::shared_ptr<const SoundLibrary> library);

  // Renders the time from the last call until scene.frame_time; nothing if that goes back. The same
  // scenes give the same samples.
  Status RenderUntil(const SoundScene& scene);
  // Renders the last scene for some more seconds, while the last picture is shown.
  Status RenderOn(double seconds);

 private:
  SoundTrack(bool hrtf, Take take)
      : hrtf_(hrtf), take_(std::move(take)), piece_(2 * kPieceFrames) {}

  static constexpr size_t kPieceFrames = 16 * Mixer::kBlockFrames;

  bool hrtf_;
  std::unique_ptr<Mixer> mixer_;  // Set by Create().
  Take take_;
  SoundScene last_;
  int64_t frames_ = 0;  // Number of frames rendered.
  std::vector<float> piece_;
};

}  // namespace lararium::audio
