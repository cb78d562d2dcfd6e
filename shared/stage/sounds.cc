#include "shared/stage/sounds.h"

#include <algorithm>

#include "shared/core/check.h"

namespace lararium::stage {

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

void Sounds::StopAll(int sound) {
  std::erase_if(playing_, [sound](const StageSound& playing) { return playing.sound == sound; });
}

void Sounds::Advance() {
  for (StageSound& sound : playing_) {
    ++sound.ticks;
  }
  std::erase_if(playing_, [&](const StageSound& sound) {
    return !sound.loops && static_cast<double>(sound.ticks) * kTickSeconds >= seconds(sound.sound);
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
