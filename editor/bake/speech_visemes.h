#pragma once

// What a mouth does for the sounds of a language.

#include <span>

#include "editor/bake/speech_synthesis.h"
#include "shared/human/face.h"

namespace lararium::bake {

// Each sound becomes the viseme of its place and manner of articulation (the fifteen of
// shared/human/face.h); diphthongs become two, affricates one, and h takes the shape of the
// vowel after it. Neighbours of one viseme are one key. Unstressed schwas are weak. Sounds
// that are no IPA of ours are a half-open mouth.
human::VisemeTrack VisemesOf(std::span<const Phoneme> phonemes, double duration);

}  // namespace lararium::bake
