#pragma once

// Forced alignment: finds when the sounds of a known text are said in a recording.
//
// The text is synthesised. That gives the sounds i = 1..N, the expected duration of each (e_i),
// and how each one sounds: the mean features m_ik of its first, middle and last third k. The
// recording is a sequence of feature vectors x_t (speech_features.h). Both are standardised
// over their loud frames, which removes much of the difference between two voices (cepstral
// mean and variance normalisation). The boundaries b_i minimise
//
//   sum_i [ sum_{t in segment i} min(c, w |x_t - m_ik(t)|^2) + (ln(d_i / (r e_i)))^2 / (2 s^2) ]
//
// with d_i = b_i+1 - b_i and r the ratio of the loud durations of recording and synthesis. This
// is an explicit-duration hidden Markov model (Ferguson, 1980; Levinson, 1986) with log-normal
// durations, solved exactly by dynamic programming
//
//   D_i(t) = min_d [ D_i-1(t - d) + C_i(t - d, t) + L_i(d) ],
//
// with C_i from running sums over t. A pause is possible between any two words; it has a cost
// where the synthesis has none. The quietest frames of the recording give the model of pauses.
// After each of a few rounds the means of a sound are moved towards the frames found in the
// recording, (tau m + sum x) / (tau + n), as in maximum a posteriori adaptation (Gauvain & Lee,
// 1994), so that the model adapts to the speaker.

#include <optional>
#include <vector>

#include "editor/bake/speech_sound.h"
#include "editor/bake/speech_synthesis.h"
#include "shared/core/status.h"

namespace lararium::bake {

// The begin of each word in seconds, if another method found it.
using WordTimes = std::vector<std::optional<double>>;

// Gives the sounds of `reference` (the same text, synthesised) with the times at which the
// recording says them, without gaps, from its beginning to its end. `words` is parallel to
// `reference.words` or empty. Fails if the recording is silent or too short for the text.
Result<std::vector<Phoneme>> AlignSpeech(const Sound& recording,
                                         const SpokenText& reference,
                                         const WordTimes& words = {});

}  // namespace lararium::bake
