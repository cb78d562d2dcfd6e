#include "editor/session/playback.h"

#include <algorithm>
#include <cmath>

#include "editor/document/frame_times.h"

namespace lararium::editor {

Playback::Playback(ProjectSession& project, const DryRunSession& dry_run)
    : project_(project), dry_run_(dry_run) {
  project.Subscribe([this](ProjectSession::Event event) {
    if (event == ProjectSession::Event::kPlaceSelected) {
      playing_ = false;
    }
  });
}

void Playback::SetTime(double seconds) {
  time_ = std::isfinite(seconds) ? std::clamp(seconds, 0.0, drama::Drama::kMaxTime) : 0.0;
}

double Playback::duration() const {
  double duration = project_.script().duration();
  if (recording_ && recording_->frames > 0) {
    duration =
        std::max(duration, static_cast<double>(recording_->frames) / recording_->frames_per_second);
  }
  return std::max(duration, dry_run_.newest() != nullptr ? dry_run_.newest()->last : 0.0);
}

int64_t Playback::frame() const {
  if (!recording_ || recording_->frames <= 0) {
    return 0;
  }
  const double frames = time_ * recording_->frames_per_second;
  return static_cast<int64_t>(frames + kSameFrame) % recording_->frames;
}

void Playback::SetFrame(int64_t frame) {
  if (recording_) {
    const int64_t last = std::max<int64_t>(recording_->frames - 1, 0);
    SetTime(static_cast<double>(std::clamp<int64_t>(frame, 0, last)) /
            recording_->frames_per_second);
  }
}

void Playback::StepFrames(int64_t frames) {
  if (recording_ && !recording_->live) {
    SetTime(TimeOfStep(time_, frames, recording_->frames_per_second, duration()));
  }
}

void Playback::Advance(double seconds) {
  const double end = duration();
  if (playing_ && end > 0.0) {
    time_ = time_ + seconds < end ? time_ + seconds : 0.0;
  }
}

}  // namespace lararium::editor
