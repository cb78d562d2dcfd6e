#pragma once

// The motion of the body in a clip, as input for retargeting, root motion and loop detection.

#include <array>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "shared/human/body_rig.h"
#include "shared/human/clip.h"
#include "shared/human/skeleton.h"

namespace lararium::import {

// All joints of one pose in the actor frame; scales are treated as uniform.
struct JointFrames {
  std::vector<glm::quat> rotations;
  std::vector<glm::vec3> positions;
};
void ComputeFrames(const human::Skeleton& skeleton,
                   std::span<const human::JointTransform> pose,
                   JointFrames& frames);

// Positions of one point at the keys of a clip; metres, actor frame.
using PointTrack = std::vector<glm::vec3>;

struct FootTrack {
  PointTrack ankle;
  PointTrack ball;              // Mean of the toe joints; empty if there are none.
  std::vector<glm::quat> turn;  // Rotation of the ankle from rest.
};

struct BodyTrack {
  float seconds_per_key = 0.0f;
  PointTrack pelvis;
  std::vector<glm::quat> pelvis_turn;  // Rotation of the pelvis from rest.
  std::array<FootTrack, 2> feet;       // Indexed by human::kRight, kLeft.

  size_t size() const { return pelvis.size(); }
};

// The body must be able to walk (human::BodyRig::walks).
BodyTrack TrackBody(const human::Skeleton& skeleton,
                    const human::BodyRig& body,
                    const human::Clip& clip);

// Says for each key whether a point stands on the floor: it moves slowly and is low for that
// point. `ground` is the velocity of the floor under the actor in m/s (a treadmill).
std::vector<bool> FindContacts(const PointTrack& point,
                               float seconds_per_key,
                               const glm::vec3& ground = glm::vec3(0.0f));

// A height that the point is rarely below.
float LowHeight(const PointTrack& point);

}  // namespace lararium::import
