#pragma once

// When the sounds of a known text are said in a recording: forced alignment.
//
// The text is synthesised; that gives the sounds i = 1..N, how long each is expected to last
// (e_i), and what each sounds like: the mean features m_ik of its first, middle and last third
// k. The recording is a sequence of feature vectors x_t (speech_features.h), standardised over
// its loud frames as those of the synthesis are over theirs, which takes out much of what makes
// two voices differ (cepstral mean and variance normalisation). Sought are boundaries b_i that
// minimise
//
//   sum_i [ sum_{t in segment i} min(c, w |x_t - m_ik(t)|^2) + (ln(d_i / (r e_i)))^2 / (2 s^2) ]
//
// with d_i = b_i+1 - b_i and r the ratio of how much is loud in recording and synthesis: an
// explicit-duration hidden Markov model (Ferguson, 1980; Levinson, 1986) with log-normal
// durations, solved exactly by dynamic programming
//
//   D_i(t) = min_d [ D_i-1(t - d) + C_i(t - d, t) + L_i(d) ],
//
// C_i from running sums over t. Between any two words there may be a pause, which costs
// something where the synthesis has none; pauses are told by the recording's own quietest
// frames. After each of a few rounds the means of a sound are moved towards what was found in
// the recording, (tau m + sum x) / (tau + n), as in maximum a posteriori adaptation (Gauvain &
// Lee, 1994), so that the model becomes that of the speaker.

#include <optional>
#include <span>
#include <vector>

#include "editor/bake/speech_sound.h"
#include "editor/bake/speech_synthesis.h"
#include "shared/core/status.h"

namespace lararium::bake {

// When a word is said, where that is known from elsewhere; empty: nobody knows.
using WordTimes = std::vector<std::optional<double>>;  // begin of each word, seconds

// The sounds of `reference` (the same text, synthesised) as they are said in the recording;
// without gaps, from its beginning to its end. words: of reference.words, or empty.
// Fails where the recording is too short for the text, or silent.
Result<std::vector<Phoneme>> AlignSpeech(const Sound& recording,
                                         const SpokenText& reference,
                                         const WordTimes& words = {});

}  // namespace lararium::bake
