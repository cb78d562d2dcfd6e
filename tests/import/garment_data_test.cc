// Garments cut over bodies of the real cast library: skipped where it is not fetched.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <glm/geometric.hpp>

#include "editor/import/cast_builder.h"
#include "editor/import/garment/draped.h"
#include "editor/import/garment/garment.h"
#include "shared/human/cloth.h"

namespace lararium::import {
namespace {

const CastLibrary* Library() {
  static const auto* library = [] {
    const char* chosen = std::getenv("LARARIUM_CAST_LIBRARY");
    auto opened =
        CastLibrary::Open(chosen != nullptr ? chosen : LARARIUM_SOURCE_DIR "/build/cast-library");
    return opened.ok() ? new CastLibrary(*std::move(opened)) : nullptr;
  }();
  return library;
}

FittedBody Body(float sex, float age, float height, float weight) {
  CastRecipe recipe;
  recipe.sex = sex;
  recipe.age = age;
  recipe.height = height;
  recipe.weight = weight;
  auto body = FitBody(*Library(), recipe);
  EXPECT_TRUE(body.ok()) << body.status().message();
  return *std::move(body);
}

std::vector<GarmentPattern> Patterns(std::initializer_list<const char*> names) {
  std::vector<GarmentPattern> patterns;
  for (const char* name : names) {
    const Json json = {{"name", name}};
    patterns.push_back(*ParseGarmentPattern(JsonView(json, name)));
  }
  return patterns;
}

std::vector<Garment> Cut(const FittedBody& body, std::initializer_list<const char*> names) {
  auto garments = CutGarments(Patterns(names), body);
  EXPECT_TRUE(garments.ok()) << garments.status().message();
  return *std::move(garments);
}

std::vector<glm::vec3> Skinned(const human::SkinnedMesh& mesh, const PosedBody& posed) {
  std::vector<glm::vec3> positions(mesh.positions.size());
  for (size_t v = 0; v < positions.size(); ++v) {
    glm::vec3 sum(0.0f);
    for (int k = 0; k < 4; ++k) {
      sum += mesh.weights[v][k] *
             glm::vec3(posed.skin[mesh.joints[v][k]] * glm::vec4(mesh.positions[v], 1.0f));
    }
    positions[v] = sum;
  }
  return positions;
}

glm::quat About(float angle, const glm::vec3& axis) { return glm::angleAxis(angle, axis); }

std::vector<JointTurn> With(const FittedBody& body, std::vector<JointTurn> more) {
  std::vector<JointTurn> turns = StandingTurns(body, 1.0f);
  turns.insert(turns.end(), more.begin(), more.end());
  return turns;
}

// How the person may stand, arms before them or beside them.
std::vector<std::vector<JointTurn>> ArmPoses(const FittedBody& body) {
  const glm::vec3 x(1, 0, 0);
  return {StandingTurns(body, 1.0f), StandingTurns(body, 0.0f), StandingTurns(body, 0.5f),
          With(body, {{"l_shoulder", About(0.4f, x)}, {"r_shoulder", About(-0.4f, x)}}),
          With(body, {{"l_shoulder", About(0.8f, x)}, {"r_shoulder", About(0.8f, x)}})};
}

// Deepest that drawn skin which lies under a garment while standing comes through it.
// Beside an opening skin is neither under it nor not; the skirt is simulated.
float Poke(const FittedBody& body, const Garment& garment, const PosedBody& posed) {
  std::vector<Triangle> triangles;
  for (size_t i = 0; i + 2 < garment.mesh.indices.size(); i += 3) {
    triangles.push_back(
        {garment.mesh.indices[i], garment.mesh.indices[i + 1], garment.mesh.indices[i + 2]});
  }
  const auto field = [&](const PosedBody& pose) {
    const std::vector<glm::vec3> places = Skinned(garment.mesh, pose);
    BodyField result(places, 0.01f, 0.025f);
    result.Add(places, triangles);
    return result;
  };
  const PosedBody standing = PoseBody(body, StandingTurns(body, 1.0f));
  const BodyField before = field(standing);
  const BodyField now = field(posed);
  const std::vector<glm::vec3> rest = Skinned(body.skin, standing);
  const std::vector<glm::vec3> moved = Skinned(body.skin, posed);
  const std::vector<glm::vec3> worn = Skinned(garment.mesh, standing);
  std::vector<glm::vec3> rim;
  for (const auto& [a, b] : OpenEdges(triangles)) {
    rim.push_back(0.5f * (worn[a] + worn[b]));
  }
  const auto beside_opening = [&rim](const glm::vec3& p) {
    return std::any_of(rim.begin(), rim.end(),
                       [&p](const glm::vec3& q) { return glm::distance(p, q) < 0.03f; });
  };
  const float hips = JointPlace(body, standing, "r_hip").y;
  float deepest = 0.0f;
  for (size_t v = 0; v < rest.size(); ++v) {
    const float inside = before.Sample(rest[v]).distance;
    const float outside = now.Sample(moved[v]).distance;
    const bool is_near = std::abs(inside) < 0.02f && std::abs(outside) < 0.02f;
    if (!garment.hidden[v] && is_near && inside < -0.004f && rest[v].y > hips &&
        !beside_opening(rest[v])) {
      deepest = std::max(deepest, outside);
    }
  }
  return deepest;
}

class Garments : public testing::Test {
 protected:
  void SetUp() override {
    if (Library() == nullptr) {
      GTEST_SKIP() << "needs the cast library: run scripts/fetch_cast_library.sh";
    }
  }
};

TEST_F(Garments, AreWholePartsOfAHuman) {
  const FittedBody body = Body(1.0f, 40.0f, 1.7f, 0.6f);
  const std::vector<Garment> garments = Cut(body, {"tunic", "apron", "toga", "palla", "sandals"});
  human::Human human;
  human.skeleton = body.skeleton;
  for (const Garment& garment : garments) {
    EXPECT_EQ(garment.hidden.size(), body.skin.positions.size());
    EXPECT_TRUE(garment.material.two_sided);
    ASSERT_TRUE(garment.colour.has_value());
    EXPECT_TRUE(garment.colour->Validate(garment.mesh.name).ok());
    EXPECT_LE(garment.mesh.positions.size(), 9000u) << garment.mesh.name;
    if (garment.cloth) {
      human.cloths.push_back(*garment.cloth);
      human.cloths.back().mesh = static_cast<uint32_t>(human.meshes.size());
    }
    human.meshes.push_back(garment.mesh);
  }
  EXPECT_EQ(human.cloths.size(), 4u);
  const Status status = human.Validate("garments");
  EXPECT_TRUE(status.ok()) << status.message();
}

TEST_F(Garments, ATunicHangsLevelBelowTheKnees) {
  const FittedBody body = Body(1.0f, 45.0f, 1.7f, 0.95f);
  const Garment tunic = std::move(Cut(body, {"tunic"})[0]);
  const PosedBody standing = PoseBody(body, StandingTurns(body, 1.0f));
  const std::vector<glm::vec3> places = Skinned(tunic.mesh, standing);
  const float knee = JointPlace(body, standing, "r_knee").y;
  float lowest = 1.0f;
  float highest = 0.0f;
  std::vector<Triangle> triangles;
  for (size_t i = 0; i + 2 < tunic.mesh.indices.size(); i += 3) {
    triangles.push_back(
        {tunic.mesh.indices[i], tunic.mesh.indices[i + 1], tunic.mesh.indices[i + 2]});
  }
  for (const auto& [a, b] : OpenEdges(triangles)) {
    const glm::vec2 along = tunic.mesh.uvs[a] - tunic.mesh.uvs[b];
    if (std::abs(along.x) > 3.0f * std::abs(along.y) && places[a].y < knee + 0.2f) {
      lowest = std::min(lowest, places[a].y);
      highest = std::max(highest, places[a].y);
    }
  }
  EXPECT_GT(lowest, knee - 0.08f);
  EXPECT_LT(highest, knee + 0.06f);
}

TEST_F(Garments, SkinNeverComesThroughATunic) {
  for (const auto& [sex, age, height, weight] :
       {std::array{1.0f, 45.0f, 1.7f, 0.95f}, std::array{0.0f, 9.0f, 1.3f, 0.5f}}) {
    const FittedBody body = Body(sex, age, height, weight);
    const Garment tunic = std::move(Cut(body, {"tunic"})[0]);
    for (const std::vector<JointTurn>& turns : ArmPoses(body)) {
      EXPECT_LT(Poke(body, tunic, PoseBody(body, turns)), 0.005f) << "aged " << age;
    }
  }
}

TEST_F(Garments, WhatIsWornBelowAnotherIsLeftOut) {
  const FittedBody body = Body(1.0f, 70.0f, 1.72f, 0.45f);
  const size_t alone = Cut(body, {"tunic"})[0].mesh.indices.size();
  const size_t below = Cut(body, {"tunic", "toga"})[0].mesh.indices.size();
  EXPECT_LT(below, alone * 3 / 4);
}

TEST_F(Garments, AreCutTheSameTwice) {
  const FittedBody body = Body(0.0f, 30.0f, 1.6f, 0.5f);
  const std::vector<Garment> first = Cut(body, {"stola"});
  const std::vector<Garment> second = Cut(body, {"stola"});
  EXPECT_EQ(first[0].mesh.positions, second[0].mesh.positions);
  EXPECT_EQ(first[0].mesh.weights, second[0].mesh.weights);
  EXPECT_EQ(first[0].hidden, second[0].hidden);
}

TEST_F(Garments, TheSkirtIsSimulatedAndHeldAtTheBelt) {
  const FittedBody body = Body(0.0f, 30.0f, 1.6f, 0.5f);
  const Garment stola = std::move(Cut(body, {"stola"})[0]);
  ASSERT_TRUE(stola.cloth.has_value());
  const human::Cloth& cloth = *stola.cloth;
  EXPECT_GT(cloth.positions.size(), 400u);
  EXPECT_LT(cloth.positions.size(), 1000u);
  float highest_free = 0.0f;
  size_t held = 0;
  for (size_t p = 0; p < cloth.positions.size(); ++p) {
    held += cloth.reach[p] == 0.0f ? 1 : 0;
    highest_free = std::max(highest_free, cloth.reach[p] > 0.0f ? cloth.positions[p].y : 0.0f);
  }
  EXPECT_GT(held, 10u);
  EXPECT_LT(highest_free, 0.7f * body.height);

  human::Human human;
  human.skeleton = body.skeleton;
  human.capsules = body.capsules;
  human.meshes.push_back(stola.mesh);
  human.cloths.push_back(cloth);
  const human::ClothModel model(human);
  human::ClothState state(model);
  std::vector<glm::mat4> pose(body.skeleton.size());
  human::ComputeActorFromJoint(body.skeleton, body.skeleton.rest, pose);
  human::ClothStep step;
  step.actor_from_joint = pose;
  step.elapsed = 1.0f / 60.0f;
  for (int i = 0; i < 120; ++i) {
    EXPECT_FALSE(human::StepCloth(model, step, state).reset);
  }
  for (size_t p = 0; p < cloth.positions.size(); ++p) {
    EXPECT_LT(glm::distance(state.particles(0)[p], cloth.positions[p]), 0.25f);
  }
}

}  // namespace
}  // namespace lararium::import
