#pragma once

// Records the sound of a show: in the video of its composite, in a sound file, or in both.

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
  // Whether the show has sounds; the writer of its video has to know.
  static bool Sounds(const Show& show) { return !show.sounds()->clips().empty(); }

  // video: a writer with sound if the show has sounds; nullptr: no video. file: .wav; empty: no
  // file. hrtf: for headphones. Borrows video.
  static Result<SoundRecording> Create(const Show& show,
                                       bool hrtf,
                                       capture::VideoWriter* video,
                                       const std::filesystem::path& file);

  // Continues with another show whose frames continue those of the previous one (Show::ResumeFrom),
  // for example in another language.
  Status SetShow(const Show& show);

  // Adds the sound up to a frame.
  Status Add(const audio::SoundScene& scene);
  // last_seconds: duration of the last frame. Completes the file, but not the video.
  Status Finish(double last_seconds);

 private:
  SoundRecording() = default;

  std::unique_ptr<audio::AudioOut> file_;
  std::unique_ptr<audio::SoundTrack> track_;  // nullptr: nothing is recorded.
};

}  // namespace lararium::show
