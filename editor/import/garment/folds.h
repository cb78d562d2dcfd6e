#pragma once

// Folds of cloth that is wider than what it hangs round.

#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>

namespace lararium::import {

// Irregular waves along a share 0..1 of a width. Closed: 1 meets 0.
class FoldWave {
 public:
  FoldWave(int count, uint64_t seed);
  // -1 in the trough, 1 on the crest.
  float At(float share) const;

 private:
  float count_;
  float phases_[4];
};

// How deep folds must be for a curve to be as long as the cloth, metres: half of what
// lies between trough and crest, 0 to deepest. curve: the place at a share from..to of
// the width, this far outside what the cloth hangs round.
float FoldDepth(const std::function<glm::vec3(float share, float out)>& curve,
                const FoldWave& wave,
                float from,
                float to,
                float length,
                float deepest);

}  // namespace lararium::import
