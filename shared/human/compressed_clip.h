#pragma once

// A clip as it is played: only what moves, in few bytes.

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "shared/human/clip.h"

namespace lararium::human {

// Structures of arrays, key by key, so that a sample reads two rows of memory. Against
// the clip it was made from, at its keys: rotations within kRotationError, translations
// and scales within kShareError of the range through which they move. Between keys the
// error grows by that of a chord against its arc, below 1e-4 radians.
class CompressedClip {
 public:
  static constexpr float kRotationError = 2.5e-4f;  // radians
  static constexpr float kShareError = 1.0e-5f;
  // What moves less than this does not move: radians, metres or share of scale.
  static constexpr float kStill = 1.0e-4f;

  CompressedClip() = default;
  // clip must be valid for a skeleton of so many joints.
  CompressedClip(const Clip& clip, size_t joint_count);

  // As SampleClip of the clip it was made from.
  void Sample(double time, std::span<JointTransform> pose) const;

  size_t bytes() const;
  size_t joint_count() const { return still_.size(); }

 private:
  // The three smaller components of a unit quaternion in 15 bits each and which one is
  // missing in the two highest bits of the first two.
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
  std::vector<JointTransform> still_;      // the first key
  std::vector<uint16_t> rotating_;         // joints
  std::vector<PackedRotation> rotations_;  // [key][track]
  VectorTracks translations_, scales_;
};

// One person's sample of many; outputs are apart.
struct SampleJob {
  const CompressedClip* clip = nullptr;
  double time = 0.0;
  std::span<JointTransform> pose;
};
void SampleClips(std::span<const SampleJob> jobs);

}  // namespace lararium::human
