#pragma once

#include <cstdint>
#include <optional>

#include "editor/session/dry_run_session.h"
#include "editor/session/preview.h"
#include "editor/session/project_session.h"

namespace lararium::editor {

// The moment of the drama that the views show, and whether it plays, in a loop.
class Playback {
 public:
  // Both arguments must outlive the playback.
  Playback(ProjectSession& project, const DryRunSession& dry_run);
  Playback(const Playback&) = delete;
  Playback& operator=(const Playback&) = delete;

  bool playing() const { return playing_; }
  void SetPlaying(bool playing) { playing_ = playing; }
  // Whether the sound is audible while the drama plays.
  bool sound() const { return sound_; }
  void SetSound(bool on) { sound_ = on; }

  // The moment that is shown, seconds.
  double time() const { return time_; }
  void SetTime(double seconds);
  // The maximum of the durations of the recording, the timeline and the dry run, seconds.
  double duration() const;

  // The recording in the camera view; nullopt while it is not open.
  const std::optional<PreviewSource>& recording() const { return recording_; }
  void SetRecording(const std::optional<PreviewSource>& recording) { recording_ = recording; }
  // The frame of the recording at the present moment. The recording starts again where it is
  // shorter than the drama.
  int64_t frame() const;
  void SetFrame(int64_t frame);
  // Moves the time by a number of frames of the recording, to the exact time of a frame.
  void StepFrames(int64_t frames);

  // Moves the time on while the drama plays.
  void Advance(double seconds);

 private:
  const ProjectSession& project_;
  const DryRunSession& dry_run_;
  std::optional<PreviewSource> recording_;
  bool playing_ = false;
  bool sound_ = true;
  double time_ = 0.0;  // Seconds.
};

}  // namespace lararium::editor
