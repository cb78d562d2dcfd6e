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
  // Metres by which a walking clip moves the actor forward (-Z) in one pass; its joints do not move
  // forward.
  float stride = 0.0f;
  std::vector<JointTransform> keys;  // [key][joint]

  size_t KeyCount(size_t joint_count) const {
    return joint_count == 0 ? 0 : keys.size() / joint_count;
  }
  Status Validate(size_t joint_count, const std::string& where) const;
};

// For each key, the sum of the angles by which its joints differ from those of the first key, in
// radians.
std::vector<float> TurnedFromFirst(const Clip& clip, size_t joint_count);

// Returns the time within a clip in seconds: looping clips wrap, others stop at the ends.
double ClipTime(double time, float duration, bool loops);

// Computes the pose at a time; times outside the clip are treated as in ClipTime(). A pure function
// of time, so seeking gives the same pose as playing.
void SampleClip(const Clip& clip, double time, std::span<JointTransform> pose);

// Blends pose = (1 - weight) * pose + weight * other; rotations take the shorter arc.
void BlendPose(std::span<JointTransform> pose, std::span<const JointTransform> other, float weight);

}  // namespace lararium::human
