#pragma once

// What nobody does on purpose: breathing, shifting one's weight, small motions of
// head and fingers. A pure function of seed and time, so that a seek finds what
// playing shows, and no two people move alike.

#include <array>
#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <span>

#include "shared/human/body.h"

namespace lararium::human {

// Angles in radians about actor axes.
struct LifeSample {
  float breath = 0.0f;        // -1 breathed out .. 1 breathed in
  float weight_shift = 0.0f;  // -1 all weight on the left leg .. 1 on the right
  glm::vec3 trunk = glm::vec3(0.0f);
  glm::vec3 head = glm::vec3(0.0f);
  std::array<std::array<float, 5>, 2> fingers = {};  // flexion
};

// Breathing at 12 to 18 breaths a minute, by seed (Tortora & Derrickson, Principles of
// Anatomy and Physiology: 12 to 20 at rest). vigour 0..1: 0 still, 1 as people are.
LifeSample SampleLife(uint64_t seed, double time, float vigour = 1.0f);

// Breathing and small motions on top of a pose. The shift of weight is the legs'
// business: ApplyLocomotion takes it.
void ApplyLife(const Skeleton& skeleton,
               const Body& body,
               const LifeSample& life,
               std::span<JointTransform> pose);

}  // namespace lararium::human
