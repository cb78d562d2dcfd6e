#include "shared/show/character_instance.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <memory>

#include "shared/show/show.h"
#include "tests/human/cloth_of_mesh.h"
#include "tests/show/small_show.h"
#include "tests/stage/test_props.h"

namespace lararium::show {
namespace {

using human::ClothDetail;

constexpr glm::vec3 kForward(0.0f, 0.0f, -1.0f);

// A strip of 3x5 vertices on one joint; it hangs from its upper edge at y = 1.5.
human::SkinnedMesh Strip() {
  human::SkinnedMesh mesh;
  mesh.name = "strip";
  for (uint32_t row = 0; row < 5; ++row) {
    for (uint32_t column = 0; column < 3; ++column) {
      mesh.positions.emplace_back(0.1f * static_cast<float>(column),
                                  1.5f - 0.1f * static_cast<float>(row), 0.0f);
      mesh.normals.push_back(kForward);
      mesh.albedo.emplace_back(0.5f);
      mesh.joints.push_back({0, 0, 0, 0});
      mesh.weights.emplace_back(1.0f, 0.0f, 0.0f, 0.0f);
      if (row > 0 && column > 0) {
        const uint32_t v = 3 * row + column;
        mesh.indices.insert(mesh.indices.end(), {v - 4, v - 3, v, v - 4, v, v - 1});
      }
    }
  }
  return mesh;
}

// A face whose mouth opens for "aa", and a strip of cloth.
std::shared_ptr<const human::Human> Speaker() {
  human::Human human;
  human.name = "speaker";
  human.skeleton.names = {"humanoid_root"};
  human.skeleton.parents = {human::Skeleton::kNoParent};
  human.skeleton.rest.resize(1);
  human.skeleton.joint_from_actor = {glm::mat4(1.0f)};
  human.meshes = {Strip(), Strip()};
  human.meshes[0].name = "face";
  human.morphs = {{"open", {{0, {14}, {glm::vec3(0.0f, -0.5f, 0.0f)}, {glm::vec3(0.0f)}}}}};
  human.face = {{"aa", {{0, 1.0f}}, {}}};
  human.cloths = {ClothOf(human.meshes[1], 1, 0.3f)};
  EXPECT_TRUE(human.Validate("speaker").ok()) << human.Validate("speaker").message();
  return std::make_shared<const human::Human>(std::move(human));
}

class BodyTest : public ::testing::Test {
 protected:
  void Speak(float strength) {
    state_.animation_state.face.mouth[static_cast<size_t>(human::Viseme::kAa)] = strength;
  }
  std::vector<glm::vec3> Vertices(const CharacterInstance::MovingMesh& mesh) const {
    const size_t count = body_.human().meshes[mesh.mesh].positions.size();
    std::vector<glm::vec3> positions(count);
    std::vector<glm::vec3> normals(count);
    body_.ComputeVertices(mesh, positions, normals);
    return positions;
  }

  CharacterInstance body_{human::MakeAnimationRig(Speaker())};
  stage::ActorState state_;
};

TEST_F(BodyTest, AFaceMovesOnlyWhileItSaysSomething) {
  body_.Step(state_, 0.0, {});
  ASSERT_EQ(body_.moving_meshes().size(), 1u);  // The cloth.
  EXPECT_TRUE(body_.moving_meshes()[0].posed);
  Speak(1.0f);
  body_.Step(state_, 0.02, {});
  ASSERT_EQ(body_.moving_meshes().size(), 2u);
  const CharacterInstance::MovingMesh face = body_.moving_meshes()[1];
  EXPECT_EQ(face.mesh, 0u);
  EXPECT_FALSE(face.posed);
  const glm::vec3 chin = body_.human().meshes[0].positions[14];
  EXPECT_LT(Vertices(face)[14].y, chin.y - 0.3f);
  EXPECT_EQ(Vertices(face)[0], body_.human().meshes[0].positions[0]);
}

TEST_F(BodyTest, AFarFaceDoesNotMove) {
  Speak(1.0f);
  body_.Step(state_, 0.0, {.face = false});
  EXPECT_EQ(body_.moving_meshes().size(), 1u);
}

TEST_F(BodyTest, WhoIsNotSeenHasNoVertices) {
  Speak(1.0f);
  body_.Step(state_, 0.0, ChooseBodyDetail(500.0f, true, {}));
  EXPECT_TRUE(body_.moving_meshes().empty());
}

TEST_F(BodyTest, ClothTrailsBehindWhoeverSetsOff) {
  for (int i = 0; i < 60; ++i) {
    body_.Step(state_, i / 60.0, {});
  }
  const float hanging = Vertices(body_.moving_meshes()[0])[13].z;
  EXPECT_NEAR(hanging, 0.0f, 0.03f);
  float furthest = 0.0f;
  for (int i = 60; i < 90; ++i) {
    state_.position.z -= 2.0f / 60.0f;  // forward
    body_.Step(state_, i / 60.0, {});
    furthest = std::max(furthest, Vertices(body_.moving_meshes()[0])[13].z);
  }
  EXPECT_GT(furthest, 0.05f);
}

TEST_F(BodyTest, ClothIsSettledAfterALeapAndAfterSeeking) {
  for (int i = 0; i < 60; ++i) {
    state_.position.z -= 3.0f / 60.0f;
    body_.Step(state_, i / 60.0, {});
  }
  for (const double time : {1.02, 50.0, 0.5}) {
    state_.position = {20.0f * static_cast<float>(time), 0.0f, 5.0f};
    body_.Step(state_, time, {});
    EXPECT_NEAR(Vertices(body_.moving_meshes()[0])[13].z, 0.0f, 0.05f) << time;
  }
}

TEST(CharacterInstance, IsAsTallAsItsHighestVertex) {
  for (const float top : {1.0f, 1.9f}) {
    human::Human human = *Speaker();
    human.skeleton.names = {"skullbase"};  // The eyes are placed near the floor then.
    for (human::SkinnedMesh& mesh : human.meshes) {
      for (glm::vec3& position : mesh.positions) {
        position.y *= top / 1.5f;
      }
    }
    const auto person = std::make_shared<const human::Human>(std::move(human));
    const float height = CharacterInstance(human::MakeAnimationRig(person)).height();
    EXPECT_NEAR(height, top, 1e-5f);
  }
}

TEST(BodyDetail, LessIsSimulatedOfWhoIsSmaller) {
  ClothDetail last = ClothDetail::kFull;
  for (const float height : {1000.0f, 200.0f, 80.0f, 20.0f}) {
    const BodyDetail detail = ChooseBodyDetail(height, false, {});
    EXPECT_GE(detail.cloth, last);
    last = detail.cloth;
  }
  EXPECT_EQ(last, ClothDetail::kSkinned);
  EXPECT_FALSE(ChooseBodyDetail(20.0f, false, {}).hair);
  EXPECT_FALSE(ChooseBodyDetail(20.0f, false, {}).face);
  EXPECT_TRUE(ChooseBodyDetail(1000.0f, false, {}).hair);
}

TEST(BodyDetail, DoesNotFlickerAtAThreshold) {
  BodyDetail detail = ChooseBodyDetail(1000.0f, false, {});
  for (float height = 1000.0f; height > 10.0f; height *= 0.93f) {
    const BodyDetail shrunk = ChooseBodyDetail(height, false, detail);
    // A slightly larger height does not bring back what has just been dropped.
    EXPECT_EQ(ChooseBodyDetail(1.05f * height, false, shrunk), shrunk) << height;
    detail = shrunk;
  }
}

ShowContent WithObjects() {
  ShowContent content = test::SmallContent();
  const auto cup = test::Model(test::MakeCup());
  content.objects = {{"cup", cup, {}}, {"other_cup", cup, {.position = {1.0f, 0.8f, 0.0f}}}};
  content.speech = {{"greeting", {}}};
  return content;
}

TEST(ShowWithObjects, StagesThePartsOfEachWhereTheyAre) {
  const std::shared_ptr<Log> log = MakeSilentLog();
  auto show = Show::Create(WithObjects(), {}, *log);
  ASSERT_TRUE(show.ok()) << show.message();
  StagedFrame staged;
  (*show)->StageFrame(test::FakePoses().Track({}), 0.1, staged);
  ASSERT_EQ(staged.things.objects.size(), 2u);
  EXPECT_EQ(staged.things.objects[1].object, 1u);
  EXPECT_EQ(staged.things.objects[1].part_count, 2u);
  const glm::mat4& part = staged.things.stage_from_part.at(staged.things.objects[1].part_begin);
  EXPECT_LT(glm::distance(glm::vec3(part[3]), glm::vec3(1.0f, 0.8f, 0.0f)), 1e-5f);
  EXPECT_EQ(staged.things.part_shown.size(), 4u);
}

TEST(ShowWithObjects, NamesThatAreTakenAreErrors) {
  ShowContent content = WithObjects();
  content.objects[0].name = "one";  // The actor's name.
  const std::shared_ptr<Log> log = MakeSilentLog();
  EXPECT_FALSE(Show::Create(std::move(content), {}, *log).ok());
}

}  // namespace
}  // namespace lararium::show
