#pragma once

#include <cmath>

namespace lararium::audio {

// The factor of an amplitude that a gain in decibels stands for.
inline float AmplitudeFromDecibels(float gain_db) { return std::pow(10.0f, gain_db / 20.0f); }

}  // namespace lararium::audio
