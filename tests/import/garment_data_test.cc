// Garments for bodies of the real cast library; skipped if it has not been fetched.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <memory>
#include <string>
#include <tuple>

#include "editor/import/cast/cast_builder.h"
#include "editor/import/cast/cast_presets.h"
#include "editor/import/wardrobe/draped.h"
#include "editor/import/wardrobe/garment.h"
#include "shared/core/json.h"
#include "shared/human/cloth.h"
#include "tests/support/test_files.h"

namespace lararium::import {
namespace {

const CastLibrary* Library() {
  static const auto* library = [] {
    auto opened = CastLibrary::Open(test::CastLibraryDir());
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
    patterns.push_back(*ParseFields<GarmentPattern>(JsonView(json, name)));
  }
  return patterns;
}

std::vector<Garment> Cut(const FittedBody& body, std::initializer_list<const char*> names) {
  auto garments = CutGarments(Patterns(names), body, NoProgress());
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

// Standing poses with arms beside and in front of the body.
std::vector<std::vector<JointTurn>> ArmPoses(const FittedBody& body) {
  const glm::vec3 x(1, 0, 0);
  return {StandingTurns(body, 1.0f), StandingTurns(body, 0.0f), StandingTurns(body, 0.5f),
          With(body, {{"l_shoulder", About(0.4f, x)}, {"r_shoulder", About(-0.4f, x)}}),
          With(body, {{"l_shoulder", About(0.8f, x)}, {"r_shoulder", About(0.8f, x)}})};
}

// The largest distance by which drawn skin that is under a garment while standing protrudes
// through it. Near openings skin is not tested; skirt and sleeves are simulated. `hidden` marks
// skin under any garment.
float Poke(const FittedBody& body,
           const Garment& garment,
           const std::vector<bool>& hidden,
           const PosedBody& posed) {
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
  const std::vector<float> arm = ArmShare(body);
  float deepest = 0.0f;
  for (size_t v = 0; v < rest.size(); ++v) {
    if (arm[body.base_of_skin[v]] > 0.5f) {
      continue;
    }
    const float inside = before.Sample(rest[v]).distance;
    const float outside = now.Sample(moved[v]).distance;
    const bool is_near = std::abs(inside) < 0.02f && std::abs(outside) < 0.02f;
    if (!hidden[v] && is_near && inside < -0.004f && rest[v].y > hips && !beside_opening(rest[v])) {
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
    ASSERT_EQ(garment.hidden.size(), body.skin.positions.size());
    ASSERT_EQ(garment.covered.size(), body.skin.positions.size());
    for (size_t v = 0; v < garment.hidden.size(); ++v) {
      EXPECT_TRUE(garment.covered[v] || !garment.hidden[v]) << garment.material.name << " " << v;
    }
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
  // Cloth below a toga and a palla need not move.
  EXPECT_GE(human.cloths.size(), 2u);
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
      EXPECT_LT(Poke(body, tunic, tunic.hidden, PoseBody(body, turns)), 0.005f) << "aged " << age;
    }
  }
}

GarmentPattern PatternOf(const Json& file) {
  auto design = ParseGarment(file.dump(), "garments/tried/garment.json");
  EXPECT_TRUE(design.ok()) << design.message();
  return UsualPattern(std::make_shared<const GarmentDesign>(*std::move(design)));
}

TEST_F(Garments, ATunicThatIsTooNarrowIsRefusedWithItsPiece) {
  Json tunic = *LoadJson(GarmentFile("tunic"));
  tunic["sizes"]["half_width"] = 0.13;
  const std::vector<GarmentPattern> patterns = {PatternOf(tunic)};
  const auto garments = CutGarments(patterns, Body(1.0f, 45.0f, 1.7f, 0.95f), NoProgress());
  ASSERT_FALSE(garments.ok());
  EXPECT_TRUE(garments.message().starts_with("garments/tried/garment.json: piece \"front\" is "))
      << garments.message();
}

// The pins of this one are further apart than its threads, and its neck is as wide as her
// shoulders.
TEST_F(Garments, AWideChitonStaysOnTheShoulders) {
  Json chiton = *LoadJson(GarmentFile("chiton"));
  chiton["sizes"]["half_width"] = "0.65 * girth";
  for (Json& piece : chiton["pieces"]) {
    piece["widths"] = Json::array({{{"down", 0}, {"half", "half_width"}}});
  }
  const GarmentPattern pattern = PatternOf(chiton);
  const auto body = FitBody(*Library(), *LoadCastPreset("server"));
  ASSERT_TRUE(body.ok()) << body.message();
  const auto fits = TryOn(pattern, *body, NoProgress());
  ASSERT_TRUE(fits.ok()) << fits.message();
  const Status status = CheckFit(*fits, *pattern.design);
  EXPECT_TRUE(status.ok()) << status.message();
}

TEST_F(Garments, TubesLieCloseToBothLegsAndArms) {
  const FittedBody body = Body(0.0f, 30.0f, 1.6f, 0.5f);
  const StandingField standing(body);
  for (const auto& [about, top, hem] :
       {std::tuple("legs", "hip - 0.05 * height", "0"),
        std::tuple("arms", "shoulder_top - 0.03 * height", "wrist")}) {
    Json file = *LoadJson(GarmentFile("sandals"));
    file["pieces"] = Json::array(
        {{{"name", "tubes"}, {"placed", "around"}, {"about", about}, {"top", top}, {"hem", hem}}});
    const std::vector<GarmentPattern> patterns = {PatternOf(file)};
    const auto garments = CutGarments(patterns, body, NoProgress());
    ASSERT_TRUE(garments.ok()) << garments.message();
    int far = 0;
    std::array<int, 2> sides = {0, 0};
    for (const glm::vec3& p :
         Skinned((*garments)[0].mesh, PoseBody(body, StandingTurns(body, 1.0f)))) {
      const float distance = standing.field.Sample(p).distance;
      EXPECT_GT(distance, -0.01f) << about;
      far += distance > 0.025f ? 1 : 0;
      ++sides[p.x < 0.0f];
    }
    EXPECT_LT(far, (sides[0] + sides[1]) / 10) << about;
    EXPECT_NEAR(sides[0], sides[1], 0.2 * sides[0]) << about;
  }
}

struct Dressed {
  FittedBody body;
  std::vector<Garment> garments;
  std::vector<bool> hidden;  // Hidden by any of them.
};

Dressed Preset(const std::string& name) {
  const auto recipe = LoadCastPreset(name);
  EXPECT_TRUE(recipe.ok()) << recipe.status().message();
  auto body = FitBody(*Library(), *recipe);
  EXPECT_TRUE(body.ok()) << body.status().message();
  std::vector<GarmentPattern> patterns;
  for (const Json& json : recipe->garments) {
    patterns.push_back(*ParseFields<GarmentPattern>(JsonView(json, name)));
  }
  auto garments = CutGarments(patterns, *body, NoProgress());
  EXPECT_TRUE(garments.ok()) << garments.status().message();
  Dressed dressed{*std::move(body), *std::move(garments), {}};
  dressed.hidden.assign(dressed.body.base_of_skin.size(), false);
  for (const Garment& garment : dressed.garments) {
    for (size_t v = 0; v < dressed.hidden.size(); ++v) {
      dressed.hidden[v] = dressed.hidden[v] || garment.hidden[v];
    }
  }
  return dressed;
}

// Arms up, a long stride, seated on a stool.
std::vector<std::vector<JointTurn>> KeyPoses(const FittedBody& body) {
  const glm::vec3 x(1, 0, 0);
  const glm::vec3 z(0, 0, 1);
  std::vector<std::vector<JointTurn>> poses = ArmPoses(body);
  poses.push_back(With(body, {{"l_shoulder", About(-1.6f, z)}, {"r_shoulder", About(1.6f, z)}}));
  poses.push_back(
      With(body,
           {{"l_hip", About(0.45f, x)}, {"r_hip", About(-0.35f, x)}, {"r_knee", About(-0.4f, x)}}));
  poses.push_back(With(body, {{"l_hip", About(1.5f, x)},
                              {"r_hip", About(1.5f, x)},
                              {"l_knee", About(-1.5f, x)},
                              {"r_knee", About(-1.5f, x)}}));
  return poses;
}

class Presets : public Garments, public testing::WithParamInterface<const char*> {};

TEST_P(Presets, SkinNeverComesThroughWhatTheyWear) {
  const Dressed dressed = Preset(GetParam());
  const std::vector<std::vector<JointTurn>> poses = KeyPoses(dressed.body);
  for (const Garment& garment : dressed.garments) {
    // The arm under a mantle lifts only a part of it.
    const float bar = garment.mesh.name == "toga" ? 0.02f : 0.01f;
    for (size_t i = 0; garment.cloth && i < poses.size(); ++i) {
      EXPECT_LT(Poke(dressed.body, garment, dressed.hidden, PoseBody(dressed.body, poses[i])), bar)
          << garment.mesh.name << " in pose " << i;
    }
  }
}

// The largest depth of a free particle in the body, beyond its depth in the bind pose.
float Depth(const human::Human& human,
            std::span<const glm::mat4> actor_from_joint,
            const human::ClothState& state) {
  const auto inside = [](const human::BodyCapsule& capsule, const glm::mat4& from_joint,
                         const glm::vec3& p) {
    const glm::vec3 a = from_joint * glm::vec4(capsule.a, 1.0f);
    const glm::vec3 b = from_joint * glm::vec4(capsule.b, 1.0f);
    const float squared = std::max(glm::dot(b - a, b - a), 1e-9f);
    const float t = std::clamp(glm::dot(p - a, b - a) / squared, 0.0f, 1.0f);
    return glm::mix(capsule.radius_a, capsule.radius_b, t) - glm::distance(p, a + t * (b - a));
  };
  float deepest = 0.0f;
  for (size_t c = 0; c < human.cloths.size(); ++c) {
    const human::Cloth& cloth = human.cloths[c];
    for (size_t p = 0; p < cloth.positions.size(); ++p) {
      const glm::vec3 now = state.particles(c)[p];
      EXPECT_TRUE(std::isfinite(now.x + now.y + now.z));
      for (const human::BodyCapsule& capsule : human.capsules) {
        const glm::mat4 bound = glm::inverse(human.skeleton.joint_from_actor[capsule.joint]);
        const float before = std::max(0.0f, inside(capsule, bound, cloth.positions[p]));
        const float depth = inside(capsule, actor_from_joint[capsule.joint], now) - before;
        deepest = std::max(deepest, cloth.reach[p] > 0.0f ? depth : 0.0f);
      }
    }
  }
  return deepest;
}

// A person turns round in half a second, sits down, and gets up again.
TEST_P(Presets, ClothFollowsTurningAndSittingOutsideOfTheBody) {
  Dressed dressed = Preset(GetParam());
  human::Human human;
  human.skeleton = dressed.body.skeleton;
  human.capsules = dressed.body.capsules;
  for (Garment& garment : dressed.garments) {
    if (garment.cloth) {
      human.cloths.push_back(*garment.cloth);
      human.cloths.back().mesh = static_cast<uint32_t>(human.meshes.size());
      human.meshes.push_back(std::move(garment.mesh));
    }
  }
  const human::ClothModel model(human);
  human::ClothState state(model);
  const std::vector<std::vector<JointTurn>> poses = KeyPoses(dressed.body);
  std::vector<glm::mat4> actor_from_joint(human.skeleton.size());
  float deepest = 0.0f;
  constexpr int kFrames = 240;
  for (int frame = 0; frame < kFrames; ++frame) {
    const float seconds = static_cast<float>(frame) / 60.0f;
    const float turned = 3.1416f * glm::smoothstep(0.5f, 1.0f, seconds);
    const float sits = glm::smoothstep(1.2f, 2.0f, seconds) - glm::smoothstep(2.8f, 3.6f, seconds);
    std::vector<human::JointTransform> pose = human.skeleton.rest;
    for (const auto& [name, turn] : StandingTurns(dressed.body, 1.0f)) {
      glm::quat& rotation = pose[JointNumber(dressed.body, name)].rotation;
      rotation = turn * rotation;
    }
    for (const char* name : {"l_hip", "r_hip", "l_knee", "r_knee"}) {
      const bool hip = name[2] == 'h';
      glm::quat& rotation = pose[JointNumber(dressed.body, name)].rotation;
      rotation = About((hip ? 1.5f : -1.5f) * sits, glm::vec3(1, 0, 0)) * rotation;
    }
    human::ComputeActorFromJoint(human.skeleton, pose, actor_from_joint);
    human::ClothStep step;
    step.actor_from_joint = actor_from_joint;
    step.stage_from_actor = glm::mat4_cast(About(turned, glm::vec3(0, 1, 0)));
    step.stage_from_actor[3].y = -0.4f * dressed.body.height / 1.7f * sits;
    step.floor_height = -0.5f;
    step.elapsed = 1.0f / 60.0f;
    EXPECT_FALSE(human::StepCloth(model, step, state).reset);
    deepest = std::max(deepest, Depth(human, actor_from_joint, state));
  }
  EXPECT_LT(deepest, 0.01f);
}

INSTANTIATE_TEST_SUITE_P(,
                         Presets,
                         testing::Values("keeper", "server", "patrician", "labourer", "girl"),
                         [](const auto& tested) { return std::string(tested.param); });

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
  const float shoulder = JointPlace(body, PoseBody(body, {}), "r_shoulder").x;
  float highest_free = 0.0f;
  size_t held = 0;
  for (size_t p = 0; p < cloth.positions.size(); ++p) {
    held += cloth.reach[p] == 0.0f ? 1 : 0;
    const bool skirt = cloth.reach[p] > 0.0f && std::abs(cloth.positions[p].x) < 0.9f * shoulder;
    highest_free = std::max(highest_free, skirt ? cloth.positions[p].y : 0.0f);
  }
  EXPECT_GT(held, 10u);
  EXPECT_LT(highest_free, 0.75f * body.height);  // Belted below the bust.

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
