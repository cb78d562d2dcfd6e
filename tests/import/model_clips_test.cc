#include "editor/import/model/model_clips.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "editor/import/model/model_placement.h"
#include "shared/core/file.h"
#include "tests/import/glb_figure.h"
#include "tests/import/plain_figure.h"
#include "tests/support/test_files.h"

namespace lararium::import {
namespace {

using ::testing::HasSubstr;

// The plain skeleton in a file whose clips rotate the left elbow.
class ModelClips : public ::testing::Test {
 protected:
  void SetUp() override {
    figure_ = test::MakeGlbFigure(PlainSkeleton());
    figure_.json["animations"] = Json::array();
  }

  // Adds a clip with these angles about the Z axis, in radians, at each of the times.
  void Add(const char* name, const std::vector<float>& times, const std::vector<float>& angles) {
    std::vector<float> rotations;
    for (const float angle : angles) {
      rotations.insert(rotations.end(),
                       {0.0f, 0.0f, std::sin(0.5f * angle), std::cos(0.5f * angle)});
    }
    const Json sampler = {{"input", figure_.AddFloats(times, 1)},
                          {"output", figure_.AddFloats(rotations, 4)}};
    const Json target = {{"node", IndexOfJoint(PlainSkeleton(), "l_elbow")}, {"path", "rotation"}};
    figure_.json["animations"].push_back(
        {{"name", name},
         {"samplers", Json::array({sampler})},
         {"channels", Json::array({{{"sampler", 0}, {"target", target}}})}});
  }

  Result<std::vector<human::Clip>> Sample(float keys_per_second = 30.0f) {
    const std::filesystem::path file = folder_ / "figure.glb";
    LARARIUM_RETURN_IF_ERROR(WriteFileAtomically(file, figure_.Glb()));
    std::vector<std::string> notes;
    LARARIUM_ASSIGN_OR_RETURN(const std::unique_ptr<ModelScene> model, ReadModelScene(file));
    LARARIUM_ASSIGN_OR_RETURN(const BindPose bind, FindBindPose(*model));
    LARARIUM_ASSIGN_OR_RETURN(const ModelRig rig,
                              FindRig(*model, bind, Content::kMotion, {}, notes));
    LARARIUM_ASSIGN_OR_RETURN(const glm::mat4 actor_from_scene,
                              PlaceFigure(*model, {}, rig, 1.0f, notes));
    LARARIUM_ASSIGN_OR_RETURN(
        skeleton_, BuildSkeleton(*model, bind, {}, rig, Content::kMotion, actor_from_scene));
    return SampleClips(*model, bind, skeleton_, keys_per_second, notes);
  }

  test::TemporaryFolder folder_;
  test::GlbFigure figure_;
  ModelSkeleton skeleton_;
};

TEST_F(ModelClips, TurnTheJointThatTheFileTurnsAndNoOther) {
  Add("bend", {0.0f, 1.0f}, {0.0f, 0.6f});
  const auto clips = Sample();
  ASSERT_TRUE(clips.ok()) << clips.message();
  ASSERT_EQ(clips->size(), 1u);
  const human::Clip& clip = clips->front();
  const size_t joints = skeleton_.joints.size();
  ASSERT_EQ(clip.KeyCount(joints), 31u);
  const glm::quat turn(std::cos(0.3f), 0.0f, 0.0f, std::sin(0.3f));
  for (size_t j = 0; j < joints; ++j) {
    const human::JointTransform& last = clip.keys[30 * joints + j];
    const glm::quat expected =
        skeleton_.joints.names[j] == "l_elbow" ? turn : glm::quat(1, 0, 0, 0);
    EXPECT_GT(std::abs(glm::dot(last.rotation, expected)), 1.0f - 1e-5f)
        << skeleton_.joints.names[j];
    EXPECT_LT(glm::distance(last.translation, skeleton_.joints.rest[j].translation), 1e-5f);
  }
}

TEST_F(ModelClips, BearNamesWithoutTheArmaturesEachOnce) {
  for (const char* name : {"Armature|Walk", "Walk", ""}) {
    Add(name, {0.0f, 0.5f}, {0.0f, 0.1f});
  }
  const auto clips = Sample();
  ASSERT_TRUE(clips.ok()) << clips.message();
  ASSERT_EQ(clips->size(), 3u);
  EXPECT_EQ((*clips)[0].name, "Walk");
  EXPECT_EQ((*clips)[1].name, "Walk'");
  EXPECT_FALSE((*clips)[2].name.empty());
}

TEST_F(ModelClips, LoopWhereTheyEndAsTheyBegin) {
  Add("there", {0.0f, 1.0f}, {0.0f, 0.6f});
  Add("and back", {0.0f, 1.0f, 2.0f}, {0.0f, 0.6f, 0.0f});
  const auto clips = Sample();
  ASSERT_TRUE(clips.ok()) << clips.message();
  EXPECT_FALSE((*clips)[0].loops);
  EXPECT_TRUE((*clips)[1].loops);
}

TEST_F(ModelClips, HaveTheirLastKeyAtTheVeryEnd) {
  Add("bend", {0.0f, 1.01f}, {0.0f, 0.6f});
  const auto clips = Sample();
  ASSERT_TRUE(clips.ok()) << clips.message();
  const human::Clip& clip = clips->front();
  EXPECT_NEAR(clip.duration, 1.01f, 1e-4f);
  ASSERT_EQ(clip.KeyCount(skeleton_.joints.size()), 31u);
  EXPECT_NEAR(clip.keys_per_second, 30.0f / 1.01f, 1e-2f);
}

TEST_F(ModelClips, OfMoreThanAnHourAreRefused) {
  Add("bend", {0.0f, 3700.0f}, {0.0f, 0.6f});
  const auto clips = Sample();
  ASSERT_FALSE(clips.ok());
  EXPECT_THAT(clips.message(), HasSubstr("clip 'bend' has an impossible duration"));
}

TEST_F(ModelClips, OfTooManyKeysAreRefused) {
  Add("bend", {0.0f, 10.0f}, {0.0f, 0.6f});
  const auto clips = Sample(1e5f);
  ASSERT_FALSE(clips.ok());
  EXPECT_THAT(clips.message(), HasSubstr("the clips are too long"));
}

}  // namespace
}  // namespace lararium::import
