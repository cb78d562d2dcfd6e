#pragma once

// The simulations of cloth.cc and spring.cc share these checks of what comes in and of what comes
// out, and steps of equal length in frames of any length. Internal to shared/human.

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <span>

#include "shared/human/finite.h"
#include "shared/human/float4.h"

namespace lararium::human {

inline constexpr float kLongestFrame = 0.25f;  // Seconds; a longer frame counts as a cut.
inline constexpr float kOriginRange = 4.0f;    // Metres after which the origin follows the actor.
inline constexpr float kFadeSeconds = 0.4f;    // Duration of the fade to and from the plain pose.
inline constexpr float kSettlingSeconds = 2.0f;
inline constexpr float kQuietSpeed = 0.02f;  // m/s

// Returns false for matrices that are not finite, a scale outside 0.0001 to 10000, an actor farther
// than 1000 km from the stage's origin or a joint farther than 1 km from the actor's.
inline bool IsPossible(const glm::mat4& stage_from_actor,
                       std::span<const glm::mat4> actor_from_joint,
                       float elapsed) {
  const float scale = glm::length(glm::vec3(stage_from_actor[0]));
  return Finite(stage_from_actor) && std::isfinite(elapsed) && scale > 1e-4f && scale < 1e4f &&
         glm::length(glm::vec3(stage_from_actor[3])) < 1e6f &&
         std::all_of(actor_from_joint.begin(), actor_from_joint.end(), [](const glm::mat4& joint) {
           return Finite(joint) && glm::length(glm::vec3(joint[3])) < 1e3f;
         });
}

// Returns false if a place or a velocity of any particle is infinite or not a number.
inline bool AllFinite(std::span<const Float4> places, std::span<const Float4> velocities) {
  Float4 sum;
  for (size_t i = 0; i < places.size(); ++i) {
    sum += (places[i] + velocities[i]) * 0.0f;
  }
  return Dot(sum, sum) == 0.0f;
}

// Calls take(share) for each step of the next `elapsed` seconds; share is 1 at the end of them.
// pending: seconds that no step has taken yet, which the next call begins with.
template <typename Take>
void TakeSteps(double step, float elapsed, double& pending, const Take& take) {
  const double before = pending;
  pending += elapsed;
  const int steps = static_cast<int>(pending / step + 1e-3);
  for (int k = 1; k <= steps; ++k) {
    take(static_cast<float>(std::clamp((double(k) * step - before) / double(elapsed), 0.0, 1.0)));
  }
  pending -= double(steps) * step;
}

}  // namespace lararium::human
