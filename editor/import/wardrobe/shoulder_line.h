#pragma once

// The line over shoulders and arms on which the upper edge of hanging cloth rests.

#include <glm/vec2.hpp>
#include <vector>

#include "editor/import/wardrobe/posed_body.h"

namespace lararium::import {

// Height and side position as functions of the length from the middle outward.
class ShoulderLine {
 public:
  // `above` is the height above the skin, metres.
  ShoulderLine(const FittedBody& body, const PosedBody& posed, float above);

  // x and y at this length from the middle; negative lengths are on the left of the person.
  glm::vec2 At(float s) const;
  float LengthTo(float x) const;
  float depth() const { return depth_; }

 private:
  float depth_ = 0.0f;
  std::vector<glm::vec2> places_;
  std::vector<float> lengths_;
};

}  // namespace lararium::import
