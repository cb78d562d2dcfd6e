#include "editor/import/wardrobe/folds.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

#include "shared/core/random.h"

namespace lararium::import {

FoldWave::FoldWave(int count, uint64_t seed) : count_(static_cast<float>(count)) {
  Random random(seed, 7);
  for (float& phase : phases_) {
    phase = static_cast<float>(random.Uniform(0.0, glm::two_pi<double>()));
  }
}

float FoldWave::At(float share) const {
  const float turn = glm::two_pi<float>() * share;
  const float phase = count_ * turn + 0.8f * std::sin(2.0f * turn + phases_[0]) +
                      0.6f * std::sin(3.0f * turn + phases_[1]) + phases_[2];
  const float size = 0.75f + 0.25f * std::sin(2.0f * turn + phases_[3]);
  return size * std::sin(phase);
}

float FoldDepth(const std::function<glm::vec3(float share, float out)>& curve,
                const FoldWave& wave,
                float from,
                float to,
                float length,
                float deepest) {
  constexpr int kSamples = 160;
  const auto length_at = [&](float depth) {
    float sum = 0.0f;
    glm::vec3 last(0.0f);
    for (int i = 0; i <= kSamples; ++i) {
      const float share = from + (to - from) * static_cast<float>(i) / kSamples;
      const glm::vec3 place = curve(share, depth * (1.0f + wave.At(share)));
      sum += i > 0 ? glm::distance(place, last) : 0.0f;
      last = place;
    }
    return sum;
  };
  float low = 0.0f;
  float high = deepest;
  for (int i = 0; i < 12; ++i) {
    const float middle = 0.5f * (low + high);
    (length_at(middle) < length ? low : high) = middle;
  }
  return low;
}

}  // namespace lararium::import
