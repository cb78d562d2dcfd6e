#include "shared/stage/sounds.h"

#include <algorithm>

#include "shared/core/check.h"

namespace lararium::stage {
namespace {

// Whether the sound has faded out.
bool IsSilent(const StageSound& sound) {
  return sound.stopped != StageSound::kPlays &&
         static_cast<double>(sound.ticks - sound.stopped) * Sounds::kTickSeconds >=
             static_cast<double>(sound.fade_out);
}

}  // namespace

Status Sounds::Add(std::string name, double seconds) {
  if (Find(name)) {
    return Status::Error("stage", "two sounds are called '" + name + "'", "rename one of them");
  }
  known_.push_back({std::move(name), seconds});
  playing_.reserve(kMaxPlaying);
  return Status();
}

std::optional<int> Sounds::Find(std::string_view name) const {
  const auto found = std::find_if(known_.begin(), known_.end(),
                                  [name](const Known& known) { return known.name == name; });
  return found == known_.end() ? std::nullopt
                               : std::optional(static_cast<int>(found - known_.begin()));
}

uint32_t Sounds::Play(const StageSound& sound) {
  CHECK(sound.sound >= 0 && static_cast<size_t>(sound.sound) < known_.size());
  if (playing_.size() >= kMaxPlaying) {
    return 0;
  }
  playing_.push_back(sound);
  playing_.back().ticks = 0;
  playing_.back().number = ++last_number_;
  return last_number_;
}

void Sounds::StopAll(int sound, double seconds) {
  for (StageSound& playing : playing_) {
    if (playing.sound == sound && playing.stopped == StageSound::kPlays) {
      playing.stopped = playing.ticks;
      playing.fade_out = static_cast<float>(seconds);
    }
  }
  std::erase_if(playing_, [sound](const StageSound& playing) {
    return playing.sound == sound && IsSilent(playing);
  });
}

float Sounds::Share(const StageSound& sound) {
  const auto part = [&](int64_t ticks, float seconds) {
    return seconds > 0.0f ? std::min(static_cast<double>(ticks) * kTickSeconds / seconds, 1.0)
                          : 1.0;
  };
  double share = Eased(sound.ease, part(sound.ticks, sound.fade));
  if (sound.stopped != StageSound::kPlays) {
    share *= Eased(sound.ease, 1.0 - part(sound.ticks - sound.stopped, sound.fade_out));
  }
  return static_cast<float>(share);
}

void Sounds::Advance() {
  for (StageSound& sound : playing_) {
    ++sound.ticks;
  }
  std::erase_if(playing_, [&](const StageSound& sound) {
    const bool ends =
        !sound.loops && static_cast<double>(sound.ticks) * kTickSeconds >= seconds(sound.sound);
    return ends || IsSilent(sound);
  });
}

void Sounds::Reset() {
  playing_.clear();
  last_number_ = 0;
}

void Sounds::Restore(const Checkpoint& checkpoint) {
  playing_ = checkpoint.playing;
  last_number_ = checkpoint.last_number;
}

}  // namespace lararium::stage
