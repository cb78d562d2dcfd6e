#pragma once

// The sounds that every project has without a recording, synthesised from physics and seeded
// random numbers; every bake gives the same. A file of the same name in the project replaces
// them.
//
// Levels are realistic relative to voices, which are at -20 dB below full scale: 0 dB is 80 dB
// of sound pressure at one metre.

#include <span>
#include <string_view>

#include "editor/bake/speech_sound.h"

namespace lararium::bake {

struct BuiltInSound {
  std::string_view name;
  std::string_view what;
  bool loops = false;  // The end continues at the beginning without a seam.
};

// The sounds brazier, door, grind, lid, pour, room and street.
std::span<const BuiltInSound> BuiltInSounds();

// The sound of that name, at 48000 samples per second. CHECKs that it exists.
Sound SynthesizeSound(std::string_view name);

}  // namespace lararium::bake
