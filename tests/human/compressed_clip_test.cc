#include "shared/human/compressed_clip.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "shared/core/random.h"
#include "shared/human/turns.h"
#include "tests/human/two_joint_human.h"

namespace lararium::human {
namespace {

using Pose = std::vector<JointTransform>;
constexpr size_t kJoints = 40;
constexpr int kKeys = 61;

float AngleBetween(const glm::quat& a, const glm::quat& b) {
  const glm::quat difference = ShorterArc(glm::conjugate(a) * b);
  return 2.0f * std::asin(std::min(glm::length(glm::vec3(difference.x, difference.y, difference.z)),
                                   1.0f));
}

// Smooth rotations of a third of the joints and translations of two joints.
Clip Swaying(uint64_t seed) {
  Random random(seed);
  Clip clip{"sway", 2.0f, 30.0f, true, 0.0f, Pose(kKeys * kJoints)};
  for (size_t joint = 0; joint < kJoints; ++joint) {
    const glm::vec3 axis =
        glm::normalize(glm::vec3{random.Normal(), random.Normal(), random.Normal()});
    const glm::quat base = TurnBy(3.0f * axis);
    const auto turns = static_cast<float>(1 + random.Below(3));
    for (int key = 0; key < kKeys; ++key) {
      const float angle = turns * 2.0f * kPiF * static_cast<float>(key) / (kKeys - 1);
      JointTransform& at = clip.keys[static_cast<size_t>(key) * kJoints + joint];
      at.rotation = joint % 3 == 0 ? base * TurnBy(0.8f * std::sin(angle) * axis) : base;
      at.translation = glm::vec3(0.1f, 0.2f, 0.3f);
      at.translation.y += joint < 2 ? 0.05f * std::sin(angle) : 0.0f;
    }
  }
  return clip;
}

TEST(CompressedClip, IsWithinItsBoundAtTheKeys) {
  for (const uint64_t seed : {1u, 2u, 3u}) {
    const Clip clip = Swaying(seed);
    const CompressedClip compressed(clip, kJoints);
    Pose pose(kJoints);
    for (int key = 0; key < kKeys - 1; ++key) {  // the last key is the first
      compressed.Sample(key / 30.0, pose);
      for (size_t joint = 0; joint < kJoints; ++joint) {
        const JointTransform& wanted = clip.keys[static_cast<size_t>(key) * kJoints + joint];
        EXPECT_LT(AngleBetween(pose[joint].rotation, wanted.rotation),
                  CompressedClip::kRotationError);
        EXPECT_LT(glm::distance(pose[joint].translation, wanted.translation),
                  2.0f * 0.1f * CompressedClip::kShareError);
      }
    }
  }
}

TEST(CompressedClip, SamplesAsTheClipDoesAtAnyTime) {
  const Clip clip = Swaying(4);
  const CompressedClip compressed(clip, kJoints);
  Pose wanted(kJoints), pose(kJoints);
  for (double time = -3.0; time < 5.0; time += 0.0137) {
    SampleClip(clip, time, wanted);
    compressed.Sample(time, pose);
    for (size_t joint = 0; joint < kJoints; ++joint) {
      EXPECT_LT(AngleBetween(pose[joint].rotation, wanted[joint].rotation),
                CompressedClip::kRotationError + 1e-4f);
    }
  }
}

TEST(CompressedClip, HoldsTheEndsOfAClipThatDoesNotLoop) {
  const Human human = TwoJointHuman();
  const CompressedClip bend(human.clips[0], 2);
  Pose pose(2), wanted(2);
  for (const double time : {-3.0, 0.0, 1.0, 99.0}) {
    SampleClip(human.clips[0], time, wanted);
    bend.Sample(time, pose);
    EXPECT_LT(AngleBetween(pose[1].rotation, wanted[1].rotation), CompressedClip::kRotationError);
  }
}

TEST(CompressedClip, KeepsOnlyWhatMoves) {
  const Clip clip = Swaying(5);
  const CompressedClip compressed(clip, kJoints);
  EXPECT_LT(8 * compressed.bytes(), clip.keys.size() * sizeof(JointTransform));
}

TEST(CompressedClip, TakesEveryRotationThereIs) {
  Random random(6);
  Clip clip{"any", 200.0f / 30.0f, 30.0f, false, 0.0f, {}};
  for (int key = 0; key <= 200; ++key) {
    JointTransform at;
    at.rotation = glm::normalize(
        glm::quat{static_cast<float>(random.Normal()), static_cast<float>(random.Normal()),
                  static_cast<float>(random.Normal()), static_cast<float>(random.Normal())});
    clip.keys.push_back(at);
  }
  const CompressedClip compressed(clip, 1);
  Pose pose(1);
  for (int key = 0; key <= 200; ++key) {
    compressed.Sample(key / 30.0, pose);
    EXPECT_LT(AngleBetween(pose[0].rotation, clip.keys[static_cast<size_t>(key)].rotation),
              CompressedClip::kRotationError + 1e-4f);
  }
}

}  // namespace
}  // namespace lararium::human
