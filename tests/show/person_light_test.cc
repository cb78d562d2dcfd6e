#include "shared/show/person_light.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "shared/core/random.h"

namespace lararium::show {
namespace {

// A person with many receivers on two joints, and vertices near them.
std::shared_ptr<const human::Human> LitHuman() {
  Random random(10);
  human::Human human;
  human.skeleton.names = {"humanoid_root", "arm"};
  human.skeleton.parents = {human::Skeleton::kNoParent, 0};
  human.skeleton.rest.resize(2);
  human.skeleton.joint_from_actor = {glm::mat4(1.0f), glm::mat4(1.0f)};
  human::LightTransfer& light = human.light;
  light.count = 9;
  light.key_poses = {human.skeleton.rest};
  const auto place = [&](float x) {
    return glm::vec3{x + static_cast<float>(random.Uniform(-0.2, 0.2)),
                     static_cast<float>(random.Uniform(0.2, 1.7)),
                     static_cast<float>(random.Uniform(-0.2, 0.2))};
  };
  for (uint32_t i = 0; i < 100; ++i) {
    light.receivers.push_back({i / 50, place(0.6f * static_cast<float>(i / 50))});
  }
  for (uint32_t i = 0; i < 30; ++i) {
    light.blockers.push_back({i / 15, place(0.6f * static_cast<float>(i / 15)), 0.08f});
  }
  human.meshes.resize(1);
  light.meshes.resize(1);
  human::LightTransfer::Mesh& lit = light.meshes[0];
  for (uint16_t v = 0; v < 300; ++v) {
    human.meshes[0].positions.push_back(place(0.0f));
    human.meshes[0].indices.push_back(v);
    lit.receivers.push_back(
        {static_cast<uint16_t>(v % 100), static_cast<uint16_t>((v + 1) % 100), 0, 0});
    lit.weights.push_back({155, 100, 0, 0});
    lit.scale.push_back(0.01f);
    for (int i = 0; i < 27; ++i) {
      lit.coefficients.push_back(i % 9 == 0 ? 100 : static_cast<int8_t>(random.Below(50)));
    }
  }
  return std::make_shared<const human::Human>(std::move(human));
}

light::ShRgb SkyFromAbove() {
  light::ShRgb sky = {};
  sky[0] = glm::vec3(3.0f, 3.2f, 4.0f);
  sky[1] = glm::vec3(1.0f, 1.0f, 1.4f);
  return sky;
}

// In each frame the arm rises a little, and the body turns and walks.
struct Moving {
  std::array<glm::mat4, 2> skin;
  glm::mat4 stage_from_actor;

  explicit Moving(int frame) {
    const auto t = static_cast<float>(frame);
    skin = {glm::mat4(1.0f), glm::rotate(glm::mat4(1.0f), 0.02f * t, glm::vec3(1, 0, 0))};
    stage_from_actor =
        glm::rotate(glm::translate(glm::mat4(1.0f), glm::vec3(0.02f * t, 0.0f, 0.0f)), 0.01f * t,
                    glm::vec3(0, 1, 0));
  }
};

std::vector<glm::vec3> LightOf(PersonLight& person, int frame) {
  const light::LightMatrix light(SkyFromAbove(), 9);
  const Moving moving(frame);
  std::vector<glm::vec3> irradiance(300);
  person.Pose(moving.skin, moving.stage_from_actor);
  person.Update(light, {}, {});
  person.LightVertices(0.0f, irradiance);
  return irradiance;
}

TEST(PersonLightInMotion, LaggingByAFrameIsNotSeen) {
  PersonLight person(LitHuman());
  for (int frame = 0; frame < 40; ++frame) {
    const std::vector<glm::vec3> lagging = LightOf(person, frame);
    PersonLight fresh(LitHuman());
    const std::vector<glm::vec3> exact = LightOf(fresh, frame);
    double error = 0.0, size = 0.0;
    for (size_t v = 0; v < exact.size(); ++v) {
      EXPECT_LT(glm::distance(lagging[v], exact[v]), 0.04f * glm::length(exact[v])) << frame;
      error += glm::dot(lagging[v] - exact[v], lagging[v] - exact[v]);
      size += glm::dot(exact[v], exact[v]);
    }
    EXPECT_LT(std::sqrt(error / size), 0.01) << frame;
  }
}

TEST(PersonLightInMotion, AfterALeapTheLightIsThatOfThePlace) {
  PersonLight person(LitHuman()), fresh(LitHuman());
  for (int frame = 0; frame < 3; ++frame) {
    LightOf(person, frame);
  }
  const std::vector<glm::vec3> leapt = LightOf(person, 400);
  const std::vector<glm::vec3> exact = LightOf(fresh, 400);
  for (size_t v = 0; v < exact.size(); ++v) {
    EXPECT_LT(glm::distance(leapt[v], exact[v]), 0.012f * glm::length(exact[v]));
  }
}

// Vertices that a coarser level left out are lit when they are needed again.
TEST(PersonLightInMotion, WhoStandsStillIsLitOnceAndWhollyWhenSeenFiner) {
  human::Human human = *LitHuman();
  human.meshes[0].coarser = {{0.1f, {0, 1, 99}}};
  const auto shared = std::make_shared<const human::Human>(std::move(human));
  PersonLight person(shared), fresh(shared);
  const light::LightMatrix light(SkyFromAbove(), 9);
  const Moving moving(5);
  std::vector<glm::vec3> irradiance(300), exact(300);
  for (const float detail : {0.0f, 0.2f, 0.0f}) {
    person.Pose(moving.skin, moving.stage_from_actor);
    person.Update(light, {}, {});
    std::fill(irradiance.begin(), irradiance.end(), glm::vec3(-1.0f));
    person.LightVertices(detail, irradiance);
  }
  fresh.Pose(moving.skin, moving.stage_from_actor);
  fresh.Update(light, {}, {});
  fresh.LightVertices(0.0f, exact);
  EXPECT_EQ(irradiance, exact);
}

}  // namespace
}  // namespace lararium::show
