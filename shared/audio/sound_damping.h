#pragma once

// How occluders, mouths and rooms change a sound; the same numbers for every graph. Private to
// shared/audio.

#include <AL/efx-presets.h>

#include <array>
#include <cstddef>

#include "shared/stage/acoustics.h"

namespace lararium::audio {

inline constexpr float kReferenceDistance = 1.0f;
inline constexpr float kMaxDistance = 200.0f;
inline constexpr float kMaxGain = 8.0f;
// Attenuation behind an occluder, decibels: overall, and additionally at 5 kHz. Reverberation gets
// half of it.
inline constexpr float kObstructedDb = -9.0f;
inline constexpr float kObstructedHighDb = -18.0f;
// Attenuation of a voice behind the speaker (Chu & Warnock, "Detailed directivity of sound fields
// around human talkers", NRC-IRC RR-104, 2002: a few decibels at middle frequencies of speech, more
// than ten at 5 kHz).
inline constexpr float kBehindDb = -4.0f;
inline constexpr float kBehindHighDb = -10.0f;
inline constexpr float kMouthConeDeg = 90.0f;  // Full level within this cone.

inline const EFXEAXREVERBPROPERTIES& PresetOf(stage::Reverb reverb) {
  static constexpr std::array<EFXEAXREVERBPROPERTIES, 9> kPresets = {{
      EFX_REVERB_PRESET_GENERIC,  // Not used: kNone has no reverberation.
      EFX_REVERB_PRESET_LIVINGROOM,
      EFX_REVERB_PRESET_WOODEN_SMALLROOM,
      EFX_REVERB_PRESET_CASTLE_SMALLROOM,
      EFX_REVERB_PRESET_CASTLE_SHORTPASSAGE,
      EFX_REVERB_PRESET_CASTLE_MEDIUMROOM,
      EFX_REVERB_PRESET_CASTLE_HALL,
      EFX_REVERB_PRESET_CASTLE_COURTYARD,
      EFX_REVERB_PRESET_CITY_STREETS,
  }};
  return kPresets[static_cast<size_t>(reverb)];
}

}  // namespace lararium::audio
