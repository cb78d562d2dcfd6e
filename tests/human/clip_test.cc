#include "shared/human/clip.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "shared/core/units.h"
#include "tests/human/two_joint_human.h"

namespace lararium::human {
namespace {

// Returns the rotation angle of a joint of a clip, about any axis.
float AngleAt(const Clip& clip, double time, size_t joint) {
  std::vector<JointTransform> pose(2);
  SampleClip(clip, time, pose);
  return 2.0f * std::acos(std::min(1.0f, std::abs(pose[joint].rotation.w)));
}

TEST(SampleClip, InterpolatesBetweenKeys) {
  const Clip bend = TwoJointHuman().clips[0];
  for (const float time : {0.0f, 0.1f, 0.125f, 0.5f, 0.9f, 1.0f}) {
    EXPECT_NEAR(AngleAt(bend, time, 1), time * kPiF / 2.0f, 1e-3f) << time;
  }
}

TEST(SampleClip, HoldsTheEndsOfAClipThatDoesNotLoop) {
  const Clip bend = TwoJointHuman().clips[0];
  EXPECT_NEAR(AngleAt(bend, -3.0, 1), 0.0f, 1e-3f);
  EXPECT_NEAR(AngleAt(bend, 99.0, 1), kPiF / 2.0f, 1e-3f);
}

TEST(SampleClip, WrapsALoopInBothDirections) {
  const Clip turn = TwoJointHuman().clips[1];
  EXPECT_NEAR(AngleAt(turn, 0.5, 0), kPiF / 2.0f, 1e-3f);
  EXPECT_NEAR(AngleAt(turn, 0.5 + 2.0 * 1000.0, 0), kPiF / 2.0f, 1e-3f);
  EXPECT_NEAR(AngleAt(turn, 0.5 - 2.0, 0), kPiF / 2.0f, 1e-3f);
}

TEST(SampleClip, SeekingEqualsPlaying) {
  const Clip turn = TwoJointHuman().clips[1];
  std::vector<JointTransform> played(2), sought(2);
  for (int frame = 0; frame < 500; ++frame) {
    SampleClip(turn, frame / 120.0, played);
  }
  SampleClip(turn, 499 / 120.0, sought);
  for (size_t joint = 0; joint < 2; ++joint) {
    EXPECT_EQ(played[joint].rotation, sought[joint].rotation);
    EXPECT_EQ(played[joint].translation, sought[joint].translation);
  }
}

TEST(BlendPose, TakesTheShorterArc) {
  std::vector<JointTransform> a(1), b(1);
  b[0].rotation = -glm::angleAxis(0.4f, glm::vec3(0, 1, 0));  // the same rotation, other sign
  b[0].translation = glm::vec3(2.0f, 0.0f, 0.0f);
  BlendPose(a, b, 0.25f);
  EXPECT_NEAR(std::abs(glm::dot(a[0].rotation, glm::angleAxis(0.1f, glm::vec3(0, 1, 0)))), 1.0f,
              1e-6f);
  EXPECT_NEAR(a[0].translation.x, 0.5f, 1e-6f);
}

TEST(BlendPose, EndsAtEitherPose) {
  const std::vector<JointTransform> rest = TwoJointHuman().skeleton.rest;
  std::vector<JointTransform> bent = rest;
  bent[1].rotation = glm::angleAxis(1.0f, glm::vec3(0, 0, 1));
  std::vector<JointTransform> pose = rest;
  BlendPose(pose, bent, 0.0f);
  EXPECT_NEAR(std::abs(glm::dot(pose[1].rotation, rest[1].rotation)), 1.0f, 1e-6f);
  BlendPose(pose, bent, 1.0f);
  EXPECT_NEAR(std::abs(glm::dot(pose[1].rotation, bent[1].rotation)), 1.0f, 1e-6f);
}

TEST(ClipValidate, AcceptsWholeClips) {
  for (const Clip& clip : TwoJointHuman().clips) {
    EXPECT_TRUE(clip.Validate(2, "here").ok());
  }
}

TEST(ClipValidate, RefusesWhatCannotBeSampled) {
  const Clip whole = TwoJointHuman().clips[0];
  Clip clip = whole;
  clip.keys.clear();
  EXPECT_FALSE(clip.Validate(2, "here").ok());
  clip = whole;
  clip.keys.pop_back();
  EXPECT_FALSE(clip.Validate(2, "here").ok());
  clip = whole;
  clip.duration = 7.0f;
  EXPECT_FALSE(clip.Validate(2, "here").ok());
  clip = whole;
  clip.keys_per_second = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(clip.Validate(2, "here").ok());
  clip = whole;
  clip.keys[3].rotation.x = std::numeric_limits<float>::infinity();
  EXPECT_FALSE(clip.Validate(2, "here").ok());
  EXPECT_FALSE(whole.Validate(0, "here").ok());
}

}  // namespace
}  // namespace lararium::human
