#pragma once

// Converts linear colours of other primaries to those of BT.709, in which light is computed.

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>

#include "editor/bake/probe.h"

namespace lararium::bake {

// CIE xy of a file's primaries and of its white.
struct Chromaticities {
  glm::dvec2 red;
  glm::dvec2 green;
  glm::dvec2 blue;
  glm::dvec2 white;
};

// Converts colours so that the file's white becomes that of BT.709 (Bradford's adaptation). Colours
// outside the gamut of BT.709 are clipped to it. Values that are infinite or no numbers stay.
// Returns an error if the primaries span no colours.
Status ConvertToBt709(const Chromaticities& from, ProbeImage& image, const std::string& where);

}  // namespace lararium::bake
