#include "shared/show/lamp_shade.h"

#include <gtest/gtest.h>

#include <array>

#include "shared/core/random.h"

namespace lararium::show {
namespace {

// A counter of 2 x 1 x 0.6 m on the floor.
stage::Occluder Counter() {
  stage::Occluder occluder;
  for (const float x : {-1.0f, 1.0f}) {
    for (const float y : {0.0f, 1.0f}) {
      for (const float z : {-0.3f, 0.3f}) {
        occluder.mesh.positions.emplace_back(x, y, z);
      }
    }
  }
  occluder.mesh.indices = {0, 1, 3, 0, 3, 2, 4, 7, 5, 4, 6, 7, 0, 4, 5, 0, 5, 1,
                           2, 3, 7, 2, 7, 6, 0, 2, 6, 0, 6, 4, 1, 5, 7, 1, 7, 3};
  return occluder;
}

light::Lamp LampAt(const glm::vec3& position) { return {position, glm::vec3(1.0f), 0.03f}; }

float Past(LampShade& shade, const glm::vec3& at, const glm::vec3& point) {
  light::Lamp lamp = LampAt(at);
  shade.SetWalls({&lamp, 1});
  return lamp.walls == nullptr ? 1.0f : light::PastWalls(*lamp.walls, at, point);
}

TEST(LampShade, ACounterHidesTheLampOnItFromTheFloorBeforeItAndFromNobodyWhoStands) {
  LampShade shade(std::array{Counter()});
  const glm::vec3 lamp(0.0f, 1.15f, 0.1f);
  EXPECT_EQ(Past(shade, lamp, {0.0f, 0.0f, -0.9f}), 0.0f);
  EXPECT_EQ(Past(shade, lamp, {0.0f, 0.2f, 0.6f}), 0.0f);
  EXPECT_EQ(Past(shade, lamp, {0.0f, 1.5f, -0.9f}), 1.0f);
  EXPECT_EQ(Past(shade, lamp, {0.8f, 1.0f, 0.0f}), 1.0f);  // A point on the counter.
  EXPECT_EQ(Past(shade, lamp, {2.0f, 1.7f, 2.0f}), 1.0f);
}

TEST(LampShade, AgreesWithRaysButNearEdges) {
  const stage::Occluder counter = Counter();
  LampShade shade(std::array{counter});
  const vision::OccluderTree tree(vision::Placed(counter.mesh, counter.stage_from_mesh));
  light::Lamp lamp = LampAt({0.3f, 0.6f, 0.9f});
  shade.SetWalls({&lamp, 1});
  Random random(3);
  int wrong = 0, hidden = 0;
  constexpr int kPoints = 2000;
  for (int i = 0; i < kPoints; ++i) {
    const glm::vec3 point{random.Uniform(-3.0, 3.0), random.Uniform(0.0, 2.0),
                          random.Uniform(-3.0, 3.0)};
    const bool expected = tree.Hides({lamp.position.x, lamp.position.y, lamp.position.z},
                                     {point.x, point.y, point.z}, light::LampWalls::kOnWall);
    const float past = light::PastWalls(*lamp.walls, lamp.position, point);
    hidden += expected ? 1 : 0;
    wrong += std::abs(past - (expected ? 0.0f : 1.0f)) > 0.5f ? 1 : 0;
  }
  EXPECT_GT(hidden, kPoints / 10);
  EXPECT_LT(wrong, kPoints / 50) << "seed 3";
}

TEST(LampShade, LooksAgainOnlyWhereALampHasMoved) {
  LampShade shade(std::array{Counter()});
  std::array lamps = {LampAt({0.0f, 1.2f, 0.0f}), LampAt({2.0f, 1.0f, 0.0f})};
  shade.SetWalls(lamps);
  const auto before = lamps;
  lamps[0].position.x += 0.01f;  // Flames move like this.
  lamps[1].position.x += 0.5f;
  shade.SetWalls(lamps);
  EXPECT_EQ(lamps[0].walls, before[0].walls);
  EXPECT_NE(lamps[1].walls, before[1].walls);
}

// Walls that an earlier frame still shows must not change.
TEST(LampShade, WhatSomebodyStillReadsStaysAsItIs) {
  LampShade shade(std::array{Counter()});
  light::Lamp lamp = LampAt({0.0f, 1.2f, 0.0f});
  shade.SetWalls({&lamp, 1});
  const light::Lamp held = lamp;
  const light::LampWalls copy = *held.walls;
  for (int i = 0; i < 5; ++i) {
    lamp.position.x += 0.3f;
    shade.SetWalls({&lamp, 1});
  }
  EXPECT_EQ(held.walls->planes, copy.planes);
}

TEST(LampShade, WhatHoldsALampHidesNothing) {
  stage::Occluder bowl = Counter();
  bowl.stage_from_mesh.scale = 0.05;
  LampShade shade(std::array{bowl});
  EXPECT_EQ(Past(shade, {0.0f, 0.02f, 0.0f}, {0.0f, 1.0f, 1.0f}), 1.0f);
}

TEST(LampShade, WithoutOccludersLampsHaveNoWalls) {
  LampShade shade({});
  light::Lamp lamp = LampAt({0.0f, 1.2f, 0.0f});
  shade.SetWalls({&lamp, 1});
  EXPECT_EQ(lamp.walls, nullptr);
}

}  // namespace
}  // namespace lararium::show
