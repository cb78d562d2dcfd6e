#include "shared/show/thing_light.h"

#include <gtest/gtest.h>

#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <vector>

#include "shared/core/units.h"
#include "shared/show/stage_light.h"
#include "tests/stage/test_props.h"

namespace lararium::show {
namespace {

// Unshadowed transfer for every vertex of a chest, as if all normals were +Y, in one key pose
// for each mask of parts.
stage::Prop MakeLitChest(const std::vector<uint32_t>& shown = {3}) {
  stage::Prop prop = test::MakeChest();
  human::LightTransfer& light = prop.light;
  light.count = 9;
  prop.light_shown = shown;
  for (size_t pose = 0; pose < shown.size(); ++pose) {
    light.key_poses.emplace_back(2);
    light.key_poses.back()[1].translation = {0.0f, 0.7f, 0.2f};
  }
  light.receivers = {{0, {0.0f, 0.9f, 0.0f}}, {1, {0.0f, 0.2f, -0.2f}}};
  const auto basis = light::EvaluateShBasis(glm::vec3(0.0f, 1.0f, 0.0f));
  for (uint16_t part = 0; part < 2; ++part) {
    human::LightTransfer::Mesh& mesh = light.meshes.emplace_back();
    mesh.receivers.assign(8, {part, 0, 0, 0});
    mesh.weights.assign(8, {255, 0, 0, 0});
    mesh.scale.assign(8 * shown.size(), 0.01f);
    for (size_t row = 0; row < 8 * 3 * shown.size(); ++row) {
      // Later key poses are half as bright.
      const float share = row < 8 * 3 ? 1.0f : 0.5f;
      for (int k = 0; k < 9; ++k) {
        const float value = light::ClampedCosineFactor(light::ShBandOf(k)) * basis[k];
        mesh.coefficients.push_back(static_cast<int8_t>(std::lround(100.0f * share * value)));
      }
    }
  }
  EXPECT_TRUE(prop.Validate("chest").ok()) << prop.Validate("chest").message();
  return prop;
}

light::ShRgb EvenSky(float radiance) {
  light::ShRgb sky = {};
  sky[0] = glm::vec3(radiance / light::EvaluateShBasis(glm::vec3(0.0f, 1.0f, 0.0f))[0]);
  return sky;
}

std::vector<glm::mat4> PartsAt(const glm::vec3& place, float lid = 0.0f) {
  const glm::mat4 body = glm::translate(glm::mat4(1.0f), place);
  const glm::mat4 hinge = glm::translate(body, {0.0f, 0.7f, 0.2f});
  return {body, glm::rotate(hinge, lid, {1.0f, 0.0f, 0.0f})};
}

// The light of every vertex of the objects, each with all of its parts.
std::vector<std::vector<glm::vec3>> Light(const std::vector<stage::Prop>& props,
                                          const std::vector<std::vector<glm::mat4>>& parts,
                                          const std::vector<std::vector<uint8_t>>& shown) {
  std::vector<std::shared_ptr<const human::Human>> cast;
  for (const stage::Prop& prop : props) {
    cast.push_back(FigureOf(prop));
  }
  StageLight stage(cast);
  std::vector<std::vector<glm::vec3>> irradiance(props.size());
  std::vector<std::vector<glm::mat4>> skins(props.size());
  std::vector<LitActor> actors;
  const light::ShRgb sky = EvenSky(1.0f);
  for (uint32_t i = 0; i < props.size(); ++i) {
    irradiance[i].resize(stage.Lights(i) ? stage.vertex_count(i) : 0);
    skins[i].resize(2);
    SkinOfFigure(parts[i], shown[i], skins[i]);
    actors.push_back({i, &sky, skins[i], parts[i][0], irradiance[i]});
  }
  stage.Pose(actors);
  stage.Light({}, actors);
  return irradiance;
}

TEST(ThingLight, AtItsKeyPoseAThingAloneHasTheLightThatWasBaked) {
  for (const float turn : {0.0f, 2.0f}) {
    std::vector<glm::mat4> parts = PartsAt({3, 0, 1});
    for (glm::mat4& part : parts) {
      part = glm::rotate(glm::mat4(1.0f), turn, {0, 1, 0}) * part;
    }
    const auto lit = Light({MakeLitChest()}, {parts}, {{1, 1}});
    ASSERT_EQ(lit[0].size(), 16u);
    for (const glm::vec3& irradiance : lit[0]) {
      EXPECT_NEAR(irradiance.g, kPiF, 0.05f);
    }
  }
}

TEST(ThingLight, AThingBesideItShadesIt) {
  const auto near = Light({MakeLitChest(), MakeLitChest()},
                          {PartsAt({0, 0, 0}), PartsAt({0.5f, 0.8f, 0})}, {{1, 1}, {1, 1}});
  const auto far = Light({MakeLitChest(), MakeLitChest()},
                         {PartsAt({0, 0, 0}), PartsAt({60, 0.8f, 0})}, {{1, 1}, {1, 1}});
  EXPECT_LT(near[0][0].g, 0.95f * far[0][0].g);
  EXPECT_NEAR(far[0][0].g, kPiF, 0.05f);
}

TEST(ThingLight, WhatHasNoLightOfItsOwnShadesAllTheSame) {
  const auto lit = Light({MakeLitChest(), test::MakeChest()},
                         {PartsAt({0, 0, 0}), PartsAt({0.5f, 0.8f, 0})}, {{1, 1}, {1, 1}});
  EXPECT_LT(lit[0][0].g, 0.95f * kPiF);
  EXPECT_TRUE(lit[1].empty());
}

// Lighting of a figure expects a light mesh for each of its meshes.
TEST(ThingLight, AFigureHasMeshesOnlyWithTheirLight) {
  EXPECT_TRUE(FigureOf(test::MakeChest())->meshes.empty());
  const auto lit = FigureOf(MakeLitChest());
  EXPECT_EQ(lit->meshes.size(), lit->light.meshes.size());
  EXPECT_EQ(lit->meshes[1].indices.size(), 36u);
}

TEST(ThingLight, ThePartsThatAreThereChooseTheKeyPose) {
  const stage::Prop prop = MakeLitChest({1, 3});
  const auto bare = Light({prop}, {PartsAt({0, 0, 0})}, {{1, 0}});
  const auto lidded = Light({prop}, {PartsAt({0, 0, 0})}, {{1, 1}});
  EXPECT_NEAR(bare[0][0].g, kPiF, 0.06f);
  EXPECT_NEAR(lidded[0][0].g, 0.5f * kPiF, 0.06f);
}

TEST(ThingMemory, AsksForLightOnlyWhenSomethingNearHasChanged) {
  ThingMemory memory(0.5f);
  std::vector<glm::mat4> skin = {glm::mat4(1.0f), glm::mat4(1.0f)};
  glm::mat4 place(1.0f);
  std::vector<light::Lamp> lamps = {{{1.0f, 1.0f, 0.0f}, glm::vec3(0.5f)}};
  std::vector<glm::vec4> blockers = {{1.5f, 0.0f, 0.0f, 0.2f}, {90.0f, 0.0f, 0.0f, 0.2f}};
  light::ShRgb sky = EvenSky(1.0f);
  const auto changed = [&] { return memory.Update(sky, lamps, place, skin, blockers); };
  EXPECT_TRUE(changed());
  EXPECT_FALSE(changed());
  blockers[1].x -= 20.0f;  // Too far to matter.
  EXPECT_FALSE(changed());
  blockers.pop_back();
  EXPECT_FALSE(changed());
  // Slow motion is noticed eventually.
  int lit = 0;
  for (int i = 0; i < 100; ++i) {
    blockers[0].x += 0.002f;
    lit += changed() ? 1 : 0;
  }
  EXPECT_GT(lit, 5);
  EXPECT_LT(lit, 30);
  sky = EvenSky(1.1f);
  EXPECT_TRUE(changed());
  lamps[0].intensity *= 1.001f;
  EXPECT_FALSE(changed());
  lamps[0].intensity *= 1.1f;
  EXPECT_TRUE(changed());
  place[3].x += 0.01f;
  EXPECT_TRUE(changed());
  skin[1] = glm::rotate(skin[1], 0.1f, {1.0f, 0.0f, 0.0f});
  EXPECT_TRUE(changed());
  blockers.clear();
  EXPECT_TRUE(changed());
  EXPECT_FALSE(changed());
}

TEST(ThingMemory, RadiusHoldsAllPartsAtRest) {
  const stage::Prop prop = test::MakeChest();
  // The lid's far corner: (0.3, 0.75, -0.2).
  EXPECT_NEAR(RadiusOf(prop), glm::length(glm::vec3(0.3f, 0.75f, 0.2f)), 1e-4f);
}

}  // namespace
}  // namespace lararium::show
