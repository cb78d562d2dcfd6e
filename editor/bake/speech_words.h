#pragma once

// When the words of an English recording begin, by pocketsphinx.

#include "editor/bake/speech_aligner.h"
#include "editor/bake/speech_sound.h"
#include "editor/bake/speech_synthesis.h"
#include "shared/core/status.h"

namespace lararium::bake {

// Listens to the recording with a grammar that is the sentence: the words of `reference` in
// their order, with pauses where there are any. Words have the dictionary's pronunciation, or
// else that of espeak-ng. Fails where the model is not installed or the sentence is not heard.
Result<WordTimes> FindEnglishWords(const Sound& recording, const SpokenText& reference);

}  // namespace lararium::bake
