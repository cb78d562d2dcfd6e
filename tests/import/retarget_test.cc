#include "editor/import/motion/retarget.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "editor/import/model/clip_track.h"
#include "editor/import/model/root_motion.h"
#include "shared/human/turns.h"
#include "tests/import/plain_figure.h"

namespace lararium::import {
namespace {

using human::Clip;
using human::Skeleton;

const Clip& Walk() {
  return *std::find_if(PlainFigure().clips.begin(), PlainFigure().clips.end(),
                       [](const Clip& clip) { return clip.name == "walk"; });
}

// Repeats a clip `passes` times and moves on by its stride in the direction of `heading`.
Clip Travelling(const Clip& clip, size_t joints, int passes, float heading) {
  Clip result = clip;
  result.keys.clear();
  const size_t intervals = clip.KeyCount(joints) - 1;
  for (size_t key = 0; key <= intervals * static_cast<size_t>(passes); ++key) {
    const float way = clip.stride * static_cast<float>(key) / static_cast<float>(intervals);
    for (size_t joint = 0; joint < joints; ++joint) {
      human::JointTransform t = clip.keys[key % intervals * joints + joint];
      if (joint == 0) {
        t.rotation = human::TurnY(heading) * t.rotation;
        t.translation = human::TurnY(heading) * (t.translation - glm::vec3(0, 0, way));
      }
      result.keys.push_back(t);
    }
  }
  result.duration *= static_cast<float>(passes);
  result.stride = 0.0f;
  result.loops = false;
  return result;
}

// The skeleton scaled by a factor, with one limb rotated at rest.
Skeleton Scaled(Skeleton skeleton, float scale) {
  for (size_t i = 0; i < skeleton.size(); ++i) {
    skeleton.rest[i].translation *= scale;
    skeleton.joint_from_actor[i][3] =
        glm::vec4(scale * glm::vec3(skeleton.joint_from_actor[i][3]), 1.0f);
  }
  return skeleton;
}

// Bound with spread arms; frames stay parallel to the actor's.
Skeleton WithSpreadArms(Skeleton skeleton) {
  for (const auto& [side, sign] : {std::pair{"r_", 1.0f}, std::pair{"l_", -1.0f}}) {
    const size_t shoulder = IndexOfJoint(skeleton, std::string(side) + "shoulder");
    const glm::quat turn = human::TurnZ(sign * 0.99f);
    for (size_t j = 0; j < skeleton.size(); ++j) {
      bool below = false;
      for (int up = skeleton.parents[j]; up >= 0; up = skeleton.parents[static_cast<size_t>(up)]) {
        below = below || static_cast<size_t>(up) == shoulder;
      }
      if (below) {
        skeleton.rest[j].translation = turn * skeleton.rest[j].translation;
      }
    }
  }
  std::vector<glm::mat4> actor_from_joint(skeleton.size());
  ComputeActorFromJoint(skeleton, skeleton.rest, actor_from_joint);
  for (size_t j = 0; j < skeleton.size(); ++j) {
    skeleton.joint_from_actor[j] = glm::inverse(actor_from_joint[j]);
  }
  return skeleton;
}

std::vector<glm::vec3> Positions(const Skeleton& skeleton, const Clip& clip, size_t key) {
  JointFrames frames;
  ComputeFrames(skeleton, std::span(clip.keys).subspan(key * skeleton.size(), skeleton.size()),
                frames);
  return frames.positions;
}

// The sole under the ball of a foot.
PointTrack Sole(const FootTrack& foot, const human::BodyRig::Leg& leg) {
  PointTrack sole;
  for (size_t key = 0; key < foot.ankle.size(); ++key) {
    const glm::vec3 rest = human::TurnY(leg.toe_out) * glm::vec3(0.0f, 0.0f, leg.ball.z) -
                           glm::vec3(0.0f, leg.ankle_height, 0.0f);
    sole.push_back(foot.ankle[key] + foot.turn[key] * rest);
  }
  return sole;
}

// The largest movement of the sole on the floor while that of the source stands.
float WorstSlide(const Skeleton& source,
                 const Clip& source_clip,
                 const Skeleton& skeleton,
                 const Clip& clip) {
  const human::BodyRig source_body = human::MakeBodyRig(source),
                       body = human::MakeBodyRig(skeleton);
  const BodyTrack source_track = TrackBody(source, source_body, source_clip);
  const BodyTrack track = TrackBody(skeleton, body, clip);
  float worst = 0.0f;
  for (size_t side = 0; side < 2; ++side) {
    const std::vector<bool> stands =
        FindContacts(source_track.feet[side].ball, source_track.seconds_per_key);
    const PointTrack sole = Sole(track.feet[side], body.legs[side]);
    size_t begin = 0;
    for (size_t key = 1; key < stands.size(); ++key) {
      begin = stands[key - 1] ? begin : key;
      if (stands[key]) {
        const glm::vec3 off = sole[key] - sole[begin];
        worst = std::max(worst, std::hypot(off.x, off.z));
      }
    }
  }
  return worst;
}

TEST(Retarget, ToTheSameSkeletonIsTheSameMotion) {
  const Skeleton& skeleton = PlainFigure().skeleton;
  const Clip source = Travelling(Walk(), skeleton.size(), 3, 0.0f);
  const auto result =
      Retarget(skeleton, source, skeleton, {.name = "", .lock_feet = false, .take_root = false});
  ASSERT_TRUE(result.ok()) << result.message();
  for (size_t key = 0; key < source.KeyCount(skeleton.size()); key += 7) {
    const auto own = Positions(skeleton, source, key), got = Positions(skeleton, *result, key);
    for (const char* joint : {"r_wrist", "l_ankle", "skullbase", "r_knee"}) {
      const size_t j = IndexOfJoint(skeleton, joint);
      // The height of a standing ankle is only known from the motion itself.
      EXPECT_NEAR(glm::distance(own[j], got[j]), 0.0f, 0.03f) << joint << " at key " << key;
    }
  }
}

TEST(Retarget, ToATallerFigureTakesLongerSteps) {
  const Skeleton& skeleton = PlainFigure().skeleton;
  const Skeleton taller = Scaled(skeleton, 1.25f);
  const auto result =
      Retarget(skeleton, Travelling(Walk(), skeleton.size(), 4, 0.7f), taller, {.name = "walk"});
  ASSERT_TRUE(result.ok()) << result.message();
  EXPECT_EQ(result->name, "walk");
  EXPECT_NEAR(result->stride, 1.25f * 4.0f * Walk().stride, 0.02f * result->stride);
  const auto first = Positions(taller, *result, 0);
  const size_t root = IndexOfJoint(taller, "humanoid_root");
  const auto last = Positions(taller, *result, result->KeyCount(taller.size()) - 1);
  EXPECT_LT(glm::distance(first[root], last[root]), 0.05f);  // The stride is removed from the keys.
}

TEST(Retarget, TurnsAWalkInAnyDirectionTowardsMinusZ) {
  const Skeleton& skeleton = PlainFigure().skeleton;
  for (const float heading : {0.0f, 1.3f, -2.5f}) {
    const auto result =
        Retarget(skeleton, Travelling(Walk(), skeleton.size(), 3, heading), skeleton);
    ASSERT_TRUE(result.ok()) << result.message();
    EXPECT_NEAR(result->stride, 3.0f * Walk().stride, 0.03f);
    const auto positions = Positions(skeleton, *result, 0);
    EXPECT_GT(positions[IndexOfJoint(skeleton, "r_hip")].x,
              positions[IndexOfJoint(skeleton, "l_hip")].x + 0.1f);
  }
}

TEST(Retarget, HoldsFeetThatStand) {
  const Skeleton& skeleton = PlainFigure().skeleton;
  Skeleton other = Scaled(skeleton, 0.8f);
  // With shins longer than thighs, copying the angles of the source would make the feet slide.
  for (const char* ankle : {"r_ankle", "l_ankle"}) {
    other.rest[IndexOfJoint(other, ankle)].translation *= 1.15f;
  }
  const Clip source = Travelling(Walk(), skeleton.size(), 4, 0.0f);
  RetargetOptions options;
  options.take_root = false;
  const auto held = Retarget(skeleton, source, other, options);
  options.lock_feet = false;
  const auto free = Retarget(skeleton, source, other, options);
  ASSERT_TRUE(held.ok() && free.ok()) << held.message();
  EXPECT_GT(WorstSlide(skeleton, source, other, *free), 0.02f);
  EXPECT_LT(WorstSlide(skeleton, source, other, *held), 0.005f);
}

TEST(Retarget, KeepsTheArmsOfAFigureBoundWithSpreadArmsWhereTheSourceHasThem) {
  const Skeleton& skeleton = PlainFigure().skeleton;
  const Skeleton spread = WithSpreadArms(skeleton);
  ASSERT_GT(RestPosition(spread, "r_wrist").y, RestPosition(skeleton, "r_wrist").y + 0.3f);
  for (const auto& [from, to] : {std::pair{&skeleton, &spread}, std::pair{&spread, &skeleton}}) {
    const auto there = Retarget(skeleton, Walk(), *from, {.name = "", .lock_feet = false});
    ASSERT_TRUE(there.ok()) << there.message();
    const auto back = Retarget(*from, *there, *to, {.name = "", .lock_feet = false});
    ASSERT_TRUE(back.ok()) << back.message();
    for (size_t key = 0; key < 20; key += 5) {
      const auto a = Positions(*from, *there, key), b = Positions(*to, *back, key);
      for (const std::string side : {"r_", "l_"}) {
        const size_t wrist = IndexOfJoint(skeleton, side + "wrist");
        const size_t elbow = IndexOfJoint(skeleton, side + "elbow");
        const glm::vec3 own = glm::normalize(a[wrist] - a[elbow]);
        EXPECT_GT(glm::dot(own, glm::normalize(b[wrist] - b[elbow])), 0.999f);
      }
    }
  }
}

TEST(Retarget, CutsALoopOfOneStride) {
  const Skeleton& skeleton = PlainFigure().skeleton;
  RetargetOptions options;
  options.loop = true;
  const auto result =
      Retarget(skeleton, Travelling(Walk(), skeleton.size(), 5, 0.0f), skeleton, options);
  ASSERT_TRUE(result.ok()) << result.message();
  EXPECT_TRUE(result->loops);
  const float passes = std::round(result->duration / Walk().duration);
  EXPECT_NEAR(result->duration, passes * Walk().duration, 0.1f);
  EXPECT_NEAR(result->stride, passes * Walk().stride, 0.06f);
  const size_t last = result->keys.size() - skeleton.size();
  for (size_t j = 0; j < skeleton.size(); ++j) {
    EXPECT_EQ(result->keys[j].translation, result->keys[last + j].translation);
  }
}

TEST(Retarget, SaysSoWhereNothingCanLoop) {
  const Skeleton& skeleton = PlainFigure().skeleton;
  Clip turning = Walk();
  for (size_t key = 0; key < turning.KeyCount(skeleton.size()); ++key) {
    for (size_t j = 0; j < skeleton.size(); ++j) {
      human::JointTransform& t = turning.keys[key * skeleton.size() + j];
      t = skeleton.rest[j];
      t.rotation = human::TurnX(0.08f * static_cast<float>(key));
    }
  }
  RetargetOptions options;
  options.loop = true;
  options.lock_feet = false;
  const auto result = Retarget(skeleton, turning, skeleton, options);
  ASSERT_FALSE(result.ok());
  EXPECT_NE(result.message().find("repeated"), std::string::npos);
}

TEST(Retarget, TakesThePartThatIsAskedFor) {
  const Skeleton& skeleton = PlainFigure().skeleton;
  RetargetOptions options;
  options.from = 0.2f;
  options.to = 0.7f;
  const auto result = Retarget(skeleton, Walk(), skeleton, options);
  ASSERT_TRUE(result.ok()) << result.message();
  EXPECT_NEAR(result->duration, 0.5f, 0.05f);
  options.from = 50.0f;
  EXPECT_FALSE(Retarget(skeleton, Walk(), skeleton, options).ok());
}

TEST(Retarget, RefusesSkeletonsThatDoNotWalkAndClipsThatDoNotFit) {
  Skeleton tree = PlainFigure().skeleton;
  for (std::string& name : tree.names) {
    name += "_branch";
  }
  EXPECT_FALSE(Retarget(PlainFigure().skeleton, Walk(), tree).ok());
  EXPECT_FALSE(Retarget(tree, Walk(), PlainFigure().skeleton).ok());
  Clip broken = Walk();
  broken.keys.pop_back();
  EXPECT_FALSE(Retarget(PlainFigure().skeleton, broken, PlainFigure().skeleton).ok());
}

TEST(TakeRootMotion, FindsTheStrideOfAClipThatWalksOnTheSpot) {
  Clip clip = Walk();
  const float stride = clip.stride;
  clip.stride = 0.0f;
  EXPECT_TRUE(TakeRootMotion(PlainFigure().skeleton, clip));
  EXPECT_NEAR(clip.stride, stride, 0.1f * stride);
}

TEST(TakeRootMotion, LeavesClipsThatStandAlone) {
  for (const Clip& clip : PlainFigure().clips) {
    if (clip.name != "walk") {
      Clip copy = clip;
      EXPECT_FALSE(TakeRootMotion(PlainFigure().skeleton, copy)) << clip.name;
      EXPECT_EQ(copy.stride, 0.0f);
    }
  }
}

}  // namespace
}  // namespace lararium::import
