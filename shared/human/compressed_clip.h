#pragma once

// A clip in the form that is played: only joints that move are stored, in few bytes.

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "shared/human/clip.h"

namespace lararium::human {

// Structures of arrays, key by key, so that a sample reads two rows of memory. At the keys of the
// original clip, rotations are within kRotationError, and translations and scales within
// kShareError of the range through which they move. Between keys the error grows by that of a chord
// against its arc, below 1e-4 radians.
class CompressedClip {
 public:
  static constexpr float kRotationError = 2.5e-4f;  // radians
  static constexpr float kShareError = 1.0e-5f;
  // Channels that move less than this are stored as constant: radians, metres or share of scale.
  static constexpr float kStill = 1.0e-4f;

  CompressedClip() = default;
  // Requires a clip that is valid for a skeleton of joint_count joints.
  CompressedClip(const Clip& clip, size_t joint_count);

  // Equivalent to SampleClip() of the original clip, within the errors above.
  void Sample(double time, std::span<JointTransform> pose) const;

  size_t bytes() const;
  size_t joint_count() const { return still_.size(); }

 private:
  // The three smaller components of a unit quaternion in 15 bits each. The two highest bits of the
  // first two values tell which component is missing.
  using PackedRotation = std::array<uint16_t, 3>;
  using PackedVector = std::array<uint16_t, 3>;
  // Vectors of one kind: translations or scales.
  struct VectorTracks {
    std::vector<uint16_t> joints;
    std::vector<glm::vec3> low, range;
    std::vector<PackedVector> keys;  // [key][track]
  };
  struct Place {
    size_t first, second;  // keys
    float t;
  };

  static PackedRotation Pack(const glm::quat& rotation);
  static glm::quat Unpack(const PackedRotation& packed);
  void PackRotations(const Clip& clip);
  static VectorTracks PackVectors(const Clip& clip,
                                  size_t joint_count,
                                  glm::vec3 JointTransform::*member);
  static void SampleVectors(const VectorTracks& tracks,
                            const Place& place,
                            glm::vec3 JointTransform::*member,
                            std::span<JointTransform> pose);

  float duration_ = 0.0f;
  float keys_per_second_ = 30.0f;
  bool loops_ = false;
  size_t key_count_ = 0;
  std::vector<JointTransform> still_;      // first key of the clip
  std::vector<uint16_t> rotating_;         // joints that rotate
  std::vector<PackedRotation> rotations_;  // [key][track]
  VectorTracks translations_, scales_;
};

}  // namespace lararium::human
