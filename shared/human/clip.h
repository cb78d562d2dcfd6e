#pragma once

#include <span>
#include <string>
#include <vector>

#include "shared/core/status.h"
#include "shared/human/skeleton.h"

namespace lararium::human {

// Poses of a whole skeleton at a fixed rate, from time 0 to duration.
struct Clip {
  std::string name;
  float duration = 0.0f;  // seconds
  float keys_per_second = 30.0f;
  bool loops = false;  // the last key equals the first
  // Metres by which a walking clip moves the actor forward (-Z) in one pass; the
  // joints themselves stay in place.
  float stride = 0.0f;
  std::vector<JointTransform> keys;  // [key][joint]

  size_t KeyCount(size_t joint_count) const {
    return joint_count == 0 ? 0 : keys.size() / joint_count;
  }
  Status Validate(size_t joint_count, const std::string& place) const;
};

// How far the joints of each key have turned from those of the first: the sum of their angles,
// radians.
std::vector<float> TurnedFromFirst(const Clip& clip, size_t joint_count);

// A time within a clip: wraps where it loops, stays at the ends otherwise; seconds.
double ClipTime(double time, float duration, bool loops);

// The pose at a time: wraps where the clip loops, holds the last key otherwise.
// A pure function of time: seeking equals playing.
void SampleClip(const Clip& clip, double time, std::span<JointTransform> pose);

// pose = (1 - weight) * pose + weight * other, rotations on the shorter arc.
void BlendPose(std::span<JointTransform> pose, std::span<const JointTransform> other, float weight);

}  // namespace lararium::human
