#pragma once

// Maps the morph targets of other programs to the visemes and expressions of our faces.

#include <optional>
#include <string>
#include <vector>

#include "shared/human/face_shape.h"

namespace lararium::import {

// A movement of the face in a file: a morph target, or an expression of several targets.
struct ForeignShape {
  std::string name;
  std::vector<human::FaceShape::Morph> morphs;
};

// Composes our 15 visemes, six expressions and blinks as far as possible. It understands our
// own names and their Oculus forms (viseme_aa), VRM's presets, the 52 of ARKit, action units of
// FACS (AU12, AU1_L; Ekman & Friesen 1978), MPEG-4's viseme numbers (ISO/IEC 14496-2) and the
// facial animation parameters of mouth, lids and brows. Shapes that exist are used directly;
// others are combined (EMFACS for the expressions). `jaw` is a joint whose frame is parallel to
// the actor's; it opens the mouth if no morph target does. The result contains sil if it
// contains any viseme.
std::vector<human::FaceShape> ComposeFace(const std::vector<ForeignShape>& shapes,
                                          std::optional<uint32_t> jaw);

}  // namespace lararium::import
