#include "editor/import/cast/plain_figure.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "shared/human/skinning.h"
#include "tests/import/closed_surface.h"
#include "tests/import/plain_figure.h"

namespace lararium::import {
namespace {

const human::Clip& ClipNamed(std::string_view name) {
  const auto found = std::find_if(PlainFigure().clips.begin(), PlainFigure().clips.end(),
                                  [&](const human::Clip& clip) { return clip.name == name; });
  CHECK(found != PlainFigure().clips.end());
  return *found;
}

const human::SkinnedMesh& PartNamed(std::string_view name) {
  const auto found = std::find_if(PlainFigure().meshes.begin(), PlainFigure().meshes.end(),
                                  [&](const auto& mesh) { return mesh.name == name; });
  CHECK(found != PlainFigure().meshes.end());
  return *found;
}

std::vector<glm::mat4> ActorFromJoint(const human::Clip& clip, double time) {
  std::vector<human::JointTransform> pose(PlainSkeleton().size());
  std::vector<glm::mat4> actor_from_joint(pose.size());
  human::SampleClip(clip, time, pose);
  human::ComputeActorFromJoint(PlainSkeleton(), pose, actor_from_joint);
  return actor_from_joint;
}

std::vector<glm::vec3> Skin(const human::SkinnedMesh& mesh, const human::Clip& clip, double time) {
  std::vector<glm::mat4> skin(PlainSkeleton().size());
  human::ComputeSkinMatrices(PlainSkeleton(), ActorFromJoint(clip, time), skin);
  std::vector<glm::vec3> positions(mesh.positions.size()), normals(mesh.positions.size());
  human::SkinMesh(mesh, skin, positions, normals);
  return positions;
}

TEST(PlainFigure, IsValid) {
  const Status status = PlainFigure().Validate("figure");
  EXPECT_TRUE(status.ok()) << status.message();
}

TEST(PlainFigure, IsAsTallAsAskedAndStandsOnTheFloor) {
  float lowest = 10.0f, highest = 0.0f;
  for (const human::SkinnedMesh& mesh : PlainFigure().meshes) {
    for (const glm::vec3& p : mesh.positions) {
      lowest = std::min(lowest, p.y);
      highest = std::max(highest, p.y);
    }
  }
  EXPECT_NEAR(lowest, 0.0f, 0.002f);
  EXPECT_NEAR(highest, 1.72f, 0.01f);
}

TEST(PlainFigure, HasHumanProportions) {
  // Shares of the height according to Winter, "Biomechanics and Motor Control of Human
  // Movement", figure 4.1.
  const auto at = [&](const char* joint) {
    return glm::vec3(
        glm::inverse(PlainSkeleton().joint_from_actor[PlainSkeleton().Find(joint).value()])[3]);
  };
  EXPECT_NEAR(at("r_hip").y / 1.72f, 0.530f, 0.015f);
  EXPECT_NEAR(at("r_knee").y / 1.72f, 0.285f, 0.015f);
  EXPECT_NEAR(at("r_ankle").y / 1.72f, 0.039f, 0.015f);
  EXPECT_NEAR(at("r_shoulder").y / 1.72f, 0.818f, 0.015f);
  EXPECT_NEAR(glm::distance(at("r_shoulder"), at("r_elbow")) / 1.72f, 0.172f, 0.015f);
  EXPECT_NEAR(glm::distance(at("r_elbow"), at("r_wrist")) / 1.72f, 0.146f, 0.015f);
  EXPECT_LT(at("l_shoulder").x, 0.0f);
  EXPECT_LT(at("r_midtarsal").z, at("r_ankle").z);
}

TEST(PlainFigure, ConsistsOfClosedSurfaces) {
  for (const human::SkinnedMesh& mesh : PlainFigure().meshes) {
    EXPECT_EQ(CountOpenEdges(mesh.indices), 0u) << mesh.name;
  }
}

TEST(PlainFigure, NormalsAgreeWithTriangles) {
  for (const human::SkinnedMesh& mesh : PlainFigure().meshes) {
    size_t against = 0;
    for (size_t i = 0; i < mesh.indices.size(); i += 3) {
      const uint32_t* t = &mesh.indices[i];
      const glm::vec3 face = glm::cross(mesh.positions[t[1]] - mesh.positions[t[0]],
                                        mesh.positions[t[2]] - mesh.positions[t[0]]);
      against += glm::dot(face, mesh.normals[t[0]]) < 0.0f ? 1 : 0;
    }
    EXPECT_LT(against, mesh.indices.size() / 3 / 50) << mesh.name;
  }
}

TEST(PlainFigure, NoVertexFollowsJointsThatAreFarApart) {
  // The joints of a vertex are on a path of at most five links of the skeleton.
  const human::Skeleton& skeleton = PlainSkeleton();
  const auto distance = [&](size_t a, size_t b) {
    int steps = 0;
    for (; a != b; ++steps) {
      size_t& deeper = a > b ? a : b;
      deeper = static_cast<size_t>(std::max<int>(skeleton.parents[deeper], 0));
    }
    return steps;
  };
  for (const human::SkinnedMesh& mesh : PlainFigure().meshes) {
    for (size_t v = 0; v < mesh.positions.size(); ++v) {
      for (int k = 1; k < 4; ++k) {
        if (mesh.weights[v][k] > 0.02f) {
          EXPECT_LE(distance(mesh.joints[v][0], mesh.joints[v][k]), 5)
              << mesh.name << ": " << skeleton.names[mesh.joints[v][0]] << ", "
              << skeleton.names[mesh.joints[v][k]];
        }
      }
    }
  }
}

TEST(PlainFigure, ScalesWithTheHeight) {
  const human::Human tall = LoadPlainFigure({.height = 1.72f * 1.25f}).value();
  ASSERT_EQ(tall.meshes.size(), PlainFigure().meshes.size());
  for (size_t m = 0; m < tall.meshes.size(); ++m) {
    ASSERT_EQ(tall.meshes[m].positions.size(), PlainFigure().meshes[m].positions.size());
    EXPECT_LT(
        glm::distance(tall.meshes[m].positions[7], 1.25f * PlainFigure().meshes[m].positions[7]),
        1e-6f);
  }
  EXPECT_NEAR(tall.clips[0].stride, 1.25f * PlainFigure().clips[0].stride, 1e-5f);
}

TEST(PlainFigure, WearsATunicOfTheGivenColour) {
  const glm::vec3 blue(0.1f, 0.2f, 0.5f);
  const human::Human human = LoadPlainFigure({.tunic = blue}).value();
  for (size_t m = 0; m < human.meshes.size(); ++m) {
    const human::SkinnedMesh& mesh = human.meshes[m];
    EXPECT_EQ(mesh.name == "tunic", mesh.albedo.front() == blue) << mesh.name;
    EXPECT_TRUE(mesh.name == "tunic" || mesh.albedo == PlainFigure().meshes[m].albedo) << mesh.name;
  }
}

TEST(PlainFigure, WavesOnceAndRepeatsWhatElseItDoes) {
  EXPECT_FALSE(ClipNamed("wave").loops);
  for (const char* name : {"walk", "idle", "look_around"}) {
    EXPECT_TRUE(ClipNamed(name).loops) << name;
  }
}

TEST(PlainWalk, EndsWhereItBegins) {
  for (const human::Clip& clip : PlainFigure().clips) {
    if (!clip.loops) {
      continue;
    }
    const size_t joints = PlainSkeleton().size();
    const size_t last = clip.keys.size() - joints;
    for (size_t j = 0; j < joints; ++j) {
      EXPECT_GT(std::abs(glm::dot(clip.keys[j].rotation, clip.keys[last + j].rotation)),
                1.0f - 1e-6f)
          << clip.name;
      EXPECT_LT(glm::distance(clip.keys[j].translation, clip.keys[last + j].translation), 1e-5f)
          << clip.name;
    }
  }
}

TEST(PlainWalk, MovesAtAHumanPace) {
  const human::Clip& walk = ClipNamed("walk");
  EXPECT_GT(walk.stride / walk.duration, 1.0f);  // Metres per second.
  EXPECT_LT(walk.stride / walk.duration, 1.5f);
}

TEST(PlainWalk, KeepsTheLowestFootOnTheFloor) {
  const human::Clip& walk = ClipNamed("walk");
  const human::SkinnedMesh& sandals = PartNamed("sandals");
  for (double time = 0.0; time < walk.duration; time += 0.01) {
    float lowest = 10.0f;
    for (const glm::vec3& p : Skin(sandals, walk, time)) {
      lowest = std::min(lowest, p.y);
    }
    EXPECT_NEAR(lowest, 0.0f, 0.015f) << time;
  }
}

TEST(PlainWalk, FeetDoNotSlide) {
  const human::Clip& walk = ClipNamed("walk");
  const human::Skeleton& skeleton = PlainSkeleton();
  // The ball of the right foot while it is on the floor, in stage coordinates: the actor moves
  // forwards (-z) by the stride in each cycle.
  const size_t ball = skeleton.Find("r_midtarsal").value();
  float first = 0.0f, least = 10.0f, most = -10.0f;
  for (double share = 0.10; share < 0.58; share += 0.01) {
    const double time = share * walk.duration;
    const float moved = walk.stride * static_cast<float>(share);
    const float z = ActorFromJoint(walk, time)[ball][3].z - moved;
    first = share < 0.105 ? z : first;
    least = std::min(least, z);
    most = std::max(most, z);
  }
  EXPECT_LT(most - least, 0.01f);
}

TEST(PlainWalk, TheKneeFollowsThePublishedCurve) {
  // Perry & Burnfield 2010: 5 at contact, 15-20 loaded, 5-10 before the heel rises, 60 at the
  // height of the swing. The tolerance allows for the correction that plants the feet.
  const human::Clip& walk = ClipNamed("walk");
  const size_t hip = PlainSkeleton().Find("r_hip").value();
  const size_t knee = PlainSkeleton().Find("r_knee").value();
  const size_t ankle = PlainSkeleton().Find("r_ankle").value();
  const auto flexion = [&](double share) {
    const auto m = ActorFromJoint(walk, share * walk.duration);
    const glm::vec3 thigh = glm::normalize(glm::vec3(m[knee][3] - m[hip][3]));
    const glm::vec3 shank = glm::normalize(glm::vec3(m[ankle][3] - m[knee][3]));
    return glm::degrees(std::acos(std::min(1.0f, glm::dot(thigh, shank))));
  };
  EXPECT_NEAR(flexion(0.00), 5.0f, 10.0f);
  EXPECT_NEAR(flexion(0.15), 17.0f, 10.0f);
  EXPECT_NEAR(flexion(0.40), 7.0f, 10.0f);
  EXPECT_NEAR(flexion(0.72), 61.0f, 10.0f);
}

TEST(PlainIdle, KeepsBothFeetStill) {
  const human::Clip& idle = ClipNamed("idle");
  for (const char* joint : {"r_ankle", "l_ankle"}) {
    const size_t index = PlainSkeleton().Find(joint).value();
    const glm::vec3 start(ActorFromJoint(idle, 0.0)[index][3]);
    for (double time = 0.0; time < idle.duration; time += 0.1) {
      EXPECT_LT(glm::distance(start, glm::vec3(ActorFromJoint(idle, time)[index][3])), 0.002f);
    }
  }
}

}  // namespace
}  // namespace lararium::import
