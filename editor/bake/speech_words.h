#pragma once

// Finds when the words of an English recording begin, with pocketsphinx.

#include "editor/bake/speech_aligner.h"
#include "editor/bake/speech_sound.h"
#include "editor/bake/speech_synthesis.h"
#include "shared/core/status.h"

namespace lararium::bake {

// Recognises the recording with a grammar that is exactly the sentence: the words of
// `reference` in order, with optional pauses. Words have the pronunciation of the dictionary
// or, if it lacks them, that of espeak-ng. Fails if the model is not installed or the sentence
// is not recognised.
Result<WordTimes> FindEnglishWords(const Sound& recording, const SpokenText& reference);

}  // namespace lararium::bake
