#pragma once

// The sounds that every project has without anybody recording them, made of physics and
// seeded chance; the same at every bake. A project's own file of the same name takes
// their place.
//
// Levels are those of life, in the measure of voices, which are at -20 dB below full
// scale: 0 dB is 80 dB of sound pressure at one metre.

#include <span>
#include <string_view>

#include "editor/bake/speech_sound.h"

namespace lararium::bake {

struct BuiltInSound {
  std::string_view name;
  std::string_view what;
  bool loops = false;  // its end goes on at its beginning without a seam
};

// brazier, door, grind, lid, pour, room, street.
std::span<const BuiltInSound> BuiltInSounds();

// CHECKs that there is one of that name. 48000 samples a second.
Sound SynthesizeSound(std::string_view name);

}  // namespace lararium::bake
