#pragma once

// Maps the sounds of a language to the shapes of a mouth.

#include <span>

#include "editor/bake/speech_synthesis.h"
#include "shared/human/face.h"

namespace lararium::bake {

// Each sound becomes the viseme of its place and manner of articulation (the fifteen of
// shared/human/face.h). Diphthongs become two visemes, affricates one, and h takes the shape of
// the vowel after it. Neighbours with the same viseme share a key. Unstressed schwas are weak.
// Sounds outside the supported IPA symbols become a half-open mouth.
human::VisemeTrack VisemesOf(std::span<const Phoneme> phonemes, double duration);

}  // namespace lararium::bake
