#pragma once

// The sound of a show as it is left behind: in the video of its composite, in a file of
// its own, or in both.

#include <filesystem>
#include <memory>

#include "shared/audio/audio_out.h"
#include "shared/audio/sound_track.h"
#include "shared/capture/video_writer.h"
#include "shared/core/status.h"
#include "shared/show/show.h"

namespace lararium::show {

class SoundRecording {
 public:
  // Whether videos of the show have sound: their writer has to know.
  static bool Sounds(const Show& show) { return !show.sounds()->clips().empty(); }

  // video: a writer with sound where the show sounds; nullptr: none. file: .wav; empty:
  // none. hrtf: as headphones want it. Borrows video.
  static Result<SoundRecording> Create(const Show& show,
                                       bool hrtf,
                                       capture::VideoWriter* video,
                                       const std::filesystem::path& file);

  // Goes on with another show, whose frames go on from those of the one before
  // (Show::GoOnFrom): in another language, say.
  Status SetShow(const Show& show);

  // What is heard until a frame.
  Status Add(const audio::SoundScene& scene);
  // The last frame was shown for so long. Completes the file, not the video.
  Status Finish(double last_seconds);

 private:
  SoundRecording() = default;

  std::unique_ptr<audio::AudioOut> file_;
  std::unique_ptr<audio::SoundTrack> track_;  // nullptr: nothing is wanted
};

}  // namespace lararium::show
