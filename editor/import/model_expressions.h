#pragma once

// From the morph targets of other programs to what our faces can be told.

#include <optional>
#include <string>
#include <vector>

#include "shared/human/face_shape.h"

namespace lararium::import {

// A movement of the face as a file has it: a morph target, or an expression of several.
struct ForeignShape {
  std::string name;
  std::vector<human::FaceShape::Morph> morphs;
};

// Our 15 visemes, six expressions and blinks, as far as they can be composed. Names that
// are understood: our own and their Oculus forms (viseme_aa), VRM's presets, the 52 of
// ARKit, action units of FACS (AU12, AU1_L; Ekman & Friesen 1978), MPEG-4's viseme
// numbers (ISO/IEC 14496-2) and the facial animation parameters of mouth, lids and
// brows. What is there as such is taken as such; the rest is put together (EMFACS for
// the expressions). jaw: a joint whose frame is parallel to the actor's; it opens the
// mouth where no morph target does. sil is always there when any viseme is.
std::vector<human::FaceShape> ComposeFace(const std::vector<ForeignShape>& shapes,
                                          std::optional<uint32_t> jaw);

}  // namespace lararium::import
