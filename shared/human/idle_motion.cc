#include "shared/human/idle_motion.h"

#include <algorithm>
#include <cmath>

#include "shared/human/turns.h"

namespace lararium::human {
namespace {

// Returns a number in 0..1 for a seed and a channel (SplitMix64's finaliser).
float Hash(uint64_t seed, uint64_t channel) {
  uint64_t x = seed + 0x9e3779b97f4a7c15ull * (channel + 1);
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
  x ^= x >> 31;
  return static_cast<float>(x >> 40) * 0x1p-24f;
}

// Smooth noise in -1..1 with about one change in `seconds`: cubic value noise whose knots are
// shifted by seed and channel.
float Noise(uint64_t seed, uint64_t channel, double time, double seconds) {
  const double position = time / seconds + 64.0 * Hash(seed, channel);
  const double knot = std::floor(position);
  const auto value = [&](double k) {
    return 2.0f * Hash(seed ^ (channel << 32), static_cast<uint64_t>(static_cast<int64_t>(k))) -
           1.0f;
  };
  const float t = static_cast<float>(position - knot);
  const float eased = t * t * t * (t * (6.0f * t - 15.0f) + 10.0f);
  return glm::mix(value(knot), value(knot + 1.0), eased);
}

// Breathes in for about two fifths of a breath and out for the rest, with a pause at the end.
float Breath(uint64_t seed, double time) {
  const double rate = (12.0 + 6.0 * Hash(seed, 1)) / 60.0;  // 1/s
  const double phase = time * rate + Hash(seed, 2) + 0.06 * Noise(seed, 3, time, 7.0);
  const float p = static_cast<float>(phase - std::floor(phase));
  const float in = glm::smoothstep(0.0f, 0.4f, p);
  const float out = glm::smoothstep(0.4f, 0.9f, p);
  const float depth = 1.0f + 0.25f * Noise(seed, 4, time, 5.0);
  return depth * (2.0f * (in - out) - 1.0f);
}

}  // namespace

IdleMotionSample SampleIdleMotion(uint64_t seed, double time, float idle_intensity) {
  IdleMotionSample idle_motion;
  idle_motion.breath = idle_intensity * Breath(seed, time);
  // Weight rests on one leg for a while, then moves to the other.
  idle_motion.weight_shift = idle_intensity * std::tanh(2.0f * Noise(seed, 10, time, 6.5));
  idle_motion.trunk = idle_intensity * glm::vec3(0.012f * Noise(seed, 11, time, 3.1),
                                                 0.025f * Noise(seed, 12, time, 4.3),
                                                 0.010f * Noise(seed, 13, time, 3.7));
  idle_motion.head =
      idle_intensity *
      glm::vec3(0.028f * Noise(seed, 20, time, 1.3) + 0.012f * Noise(seed, 21, time, 0.45),
                0.040f * Noise(seed, 22, time, 1.9) + 0.012f * Noise(seed, 23, time, 0.5),
                0.025f * Noise(seed, 24, time, 2.3));
  for (size_t side = 0; side < 2; ++side) {
    for (size_t finger = 0; finger < 5; ++finger) {
      idle_motion.fingers[side][finger] =
          idle_intensity * 0.09f * Noise(seed, 30 + 5 * side + finger, time, 2.1);
    }
  }
  return idle_motion;
}

void ApplyIdleMotion(const Skeleton& skeleton,
                     const BodyRig& body,
                     const IdleMotionSample& idle_motion,
                     std::span<JointTransform> pose) {
  // The chest rises over the upper half of the spine; the head stays level.
  constexpr float kChest = 0.012f, kShoulders = 0.022f;  // radians
  const size_t upper = body.spine.size() / 2;
  const float share = 1.0f / static_cast<float>(std::max<size_t>(body.spine.size() - upper, 1));
  const glm::vec3 trunk = idle_motion.trunk + glm::vec3(kChest * idle_motion.breath, 0.0f, 0.0f);
  for (size_t i = upper; i < body.spine.size(); ++i) {
    TurnInActor(skeleton, body.spine[i], TurnBy(share * trunk), pose);
  }
  for (const int side : {kRight, kLeft}) {
    const BodyRig::Arm& arm = body.arms[static_cast<size_t>(side)];
    if (arm.clavicle != kNoJoint) {
      TurnInActor(skeleton, arm.clavicle, TurnZ(SideSign(side) * kShoulders * idle_motion.breath),
                  pose);
      // Keeps the arm hanging.
      TurnInActor(skeleton, arm.shoulder, TurnZ(-SideSign(side) * kShoulders * idle_motion.breath),
                  pose);
    }
  }
  const glm::vec3 head = idle_motion.head - glm::vec3(kChest * idle_motion.breath, 0.0f, 0.0f);
  for (const JointIndex joint : body.neck) {
    TurnInActor(skeleton, joint, TurnBy(head / static_cast<float>(body.neck.size())), pose);
  }
}

}  // namespace lararium::human
