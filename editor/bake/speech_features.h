#pragma once

// Features of a voice over time, for recognising the sounds of speech.

#include <array>
#include <span>
#include <vector>

namespace lararium::bake {

inline constexpr double kFeatureStep = 0.005;  // seconds from one frame to the next
inline constexpr int kFeatureCount = 14;

// Features of a frame: mel cepstra c1..c12 (Davis & Mermelstein, 1980: 24 triangular bands from
// 80 Hz to 7.2 kHz or nine tenths of the band, DCT-II of their log energies) of Hann windows of
// 25 ms after first differences of the signal; the log energy of a window of 10 ms; and the
// spectral change, the root of the squared difference of the cepstra 15 ms before and after.
// Energy is in nepers. Nothing is normalised here.
using Features = std::array<float, kFeatureCount>;
inline constexpr int kEnergy = 12;  // index of the log energy
inline constexpr int kChange = 13;  // index of the spectral change

// The centre of frame i is at about (i + 0.5) kFeatureStep.
std::vector<Features> ComputeFeatures(std::span<const float> samples, int rate);

// Resamples with a windowed sinc of 32 zero crossings, cut off at the lower of the two Nyquist
// frequencies.
std::vector<float> Resample(std::span<const float> samples, int rate, int new_rate);

}  // namespace lararium::bake
