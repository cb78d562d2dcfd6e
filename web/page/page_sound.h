#pragma once

// The sound of a show in a page: schedules it in Web Audio a little ahead of what is heard.

#include <memory>
#include <vector>

#include "shared/audio/mixer.h"
#include "shared/audio/sound_clock.h"
#include "shared/audio/sound_library.h"
#include "shared/audio/sound_scene.h"
#include "shared/core/status.h"

namespace lararium::web {

class PageSound {
 public:
  // Fails if the page has no output for sound. A page has one at a time.
  static Result<std::unique_ptr<PageSound>> Create(
      std::shared_ptr<const audio::SoundLibrary> library);

  // Plays a scene that is seen now. Until the next one, its clips go on by themselves.
  void Show(const audio::SoundScene& scene);

 private:
  explicit PageSound(std::unique_ptr<audio::Mixer> mixer);

  std::unique_ptr<audio::Mixer> mixer_;
  audio::SoundClock clock_;
  std::vector<float> silence_;  // Mixer::Render() fills it with silence.
};

}  // namespace lararium::web
