#pragma once

// A clip looked at as motion of a body through space: what retargeting, root motion and
// loops are found from.

#include <array>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "shared/human/body.h"
#include "shared/human/clip.h"
#include "shared/human/skeleton.h"

namespace lararium::import {

// Every joint of one pose in the actor frame; scales are taken as uniform.
struct JointFrames {
  std::vector<glm::quat> rotations;
  std::vector<glm::vec3> positions;
};
void ComputeFrames(const human::Skeleton& skeleton,
                   std::span<const human::JointTransform> pose,
                   JointFrames& frames);

// One point over the keys of a clip; metres, actor frame.
using PointTrack = std::vector<glm::vec3>;

struct FootTrack {
  PointTrack ankle;
  PointTrack ball;              // the mean of the toes' joints; empty where there are none
  std::vector<glm::quat> turn;  // of the ankle from rest
};

struct BodyTrack {
  float seconds_per_key = 0.0f;
  PointTrack pelvis;
  std::vector<glm::quat> pelvis_turn;  // from rest
  std::array<FootTrack, 2> feet;       // human::kRight, kLeft

  size_t size() const { return pelvis.size(); }
};

// The body must walk (human::Body::walks).
BodyTrack TrackBody(const human::Skeleton& skeleton,
                    const human::Body& body,
                    const human::Clip& clip);

// Which keys a point stands still on the floor: slow, and low for that point. ground:
// metres a second by which the floor moves under the actor (a treadmill).
std::vector<bool> FindContacts(const PointTrack& point,
                               float seconds_per_key,
                               const glm::vec3& ground = glm::vec3(0.0f));

// The height that a point seldom goes below.
float LowHeight(const PointTrack& point);

}  // namespace lararium::import
