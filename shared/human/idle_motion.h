#pragma once

// Unconscious motion: breathing, shifting of weight, small motions of head and fingers. It is a
// pure function of seed and time, so seeking gives the same motion as playing, and people with
// different seeds move differently.

#include <array>
#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <span>

#include "shared/human/body_rig.h"

namespace lararium::human {

// Angles in radians about actor axes.
struct IdleMotionSample {
  float breath = 0.0f;        // -1 exhaled .. 1 inhaled
  float weight_shift = 0.0f;  // -1 all weight on the left leg .. 1 on the right
  glm::vec3 trunk = glm::vec3(0.0f);
  glm::vec3 head = glm::vec3(0.0f);
  std::array<std::array<float, 5>, 2> fingers = {};  // flexion
};

// Samples the idle motion. The seed chooses 12 to 18 breaths a minute (Tortora & Derrickson,
// Principles of Anatomy and Physiology: 12 to 20 at rest). idle_intensity: 0 is still, 1 is
// natural.
IdleMotionSample SampleIdleMotion(uint64_t seed, double time, float idle_intensity = 1.0f);

// Adds breathing and small motions to a pose. ApplyLocomotion applies the shift of weight.
void ApplyIdleMotion(const Skeleton& skeleton,
                     const BodyRig& body,
                     const IdleMotionSample& idle_motion,
                     std::span<JointTransform> pose);

}  // namespace lararium::human
