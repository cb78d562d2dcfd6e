#pragma once

// Folds of cloth that is wider than its support.

#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>

namespace lararium::import {

// Irregular waves along a share 0..1 of a width. They are periodic: 1 meets 0.
class FoldWave {
 public:
  FoldWave(int count, uint64_t seed);
  // From -1 in the trough to 1 on the crest.
  float At(float share) const;

 private:
  float count_;
  float phases_[4];
};

// The depth of folds in metres (half of the distance from trough to crest, 0 to `deepest`) that
// makes a curve as long as the cloth. `curve` gives the position at a share from..to of the
// width, at a distance outside the support.
float FoldDepth(const std::function<glm::vec3(float share, float out)>& curve,
                const FoldWave& wave,
                float from,
                float to,
                float length,
                float deepest);

}  // namespace lararium::import
