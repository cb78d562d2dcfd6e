#include "shared/stage/navigation.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

namespace lararium::stage {
namespace {

constexpr float kTick = 1.0f / static_cast<float>(Navigation::kTicksPerSecond);

std::unique_ptr<Navigation> Make(std::span<const NavigationSolid> solids = {},
                                 std::span<const BlockedArea> areas = {}) {
  NavigationOptions options;
  options.floor = {{-4, -4}, {4, -4}, {4, 4}, {-4, 4}};
  auto made = Navigation::Create(options, solids, areas);
  EXPECT_TRUE(made.ok()) << made.message();
  return *std::move(made);
}

// A wall from x = -1 to 1 at z = -0.1 .. 0.1.
BlockedArea Counter(bool gate = false) {
  return {{{-1.0f, -0.1f}, {1.0f, -0.1f}, {1.0f, 0.1f}, {-1.0f, 0.1f}}, gate};
}

geometry::TriangleMesh Box(const glm::vec3& low, const glm::vec3& high) {
  geometry::TriangleMesh mesh;
  for (int i = 0; i < 8; ++i) {
    mesh.positions.emplace_back(i & 1 ? high.x : low.x, i & 2 ? high.y : low.y,
                                i & 4 ? high.z : low.z);
  }
  mesh.indices = {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                  2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
  return mesh;
}

TEST(Navigation, AWayOverAnEmptyFloorIsStraight) {
  const auto navigation = Make();
  const auto way = navigation->FindWay({-2, 1}, {3, -2});
  ASSERT_TRUE(way.has_value());
  EXPECT_TRUE(way->complete);
  EXPECT_LT(glm::distance(way->point, glm::vec2(3, -2)), 1e-3f);
  EXPECT_NEAR(way->length, glm::distance(glm::vec2(-2, 1), glm::vec2(3, -2)), 1e-3f);
}

TEST(Navigation, AWayLeadsAroundWhatBlocks) {
  const BlockedArea areas[] = {Counter()};
  const auto navigation = Make({}, areas);
  const auto way = navigation->FindWay({0, 1}, {0, -1});
  ASSERT_TRUE(way.has_value());
  EXPECT_TRUE(way->complete);
  // The path goes round the corner at x = 1, z = +-0.1, at a distance of 0.25 m.
  const float shortest = 2.0f * glm::distance(glm::vec2(0, 1), glm::vec2(1.25f, 0.0f));
  EXPECT_GT(way->length, shortest - 0.15f);
  EXPECT_LT(way->length, shortest + 0.3f);
}

TEST(Navigation, OccludersAreWalls) {
  const geometry::TriangleMesh wall = Box({-10, 0, -0.1f}, {10, 2, 0.1f});
  const NavigationSolid solids[] = {{&wall, {}}};
  const auto navigation = Make(solids);
  const auto way = navigation->FindWay({0, 2}, {0.5f, -2});
  ASSERT_TRUE(way.has_value());
  EXPECT_FALSE(way->complete);
  EXPECT_GT(way->point.y, 0.3f);
  EXPECT_LT(way->point.y, 0.5f);
  EXPECT_NEAR(way->point.x, 0.5f, 0.2f);
}

TEST(Navigation, ScaledOccludersBlockWhereTheyStandOnTheStage) {
  const geometry::TriangleMesh wall = Box({-100, 0, -1}, {100, 20, 1});
  geometry::Similarity3 stage_from_mesh;
  stage_from_mesh.scale = 0.1;
  stage_from_mesh.translation = {0, 0, 2};
  const NavigationSolid solids[] = {{&wall, stage_from_mesh}};
  const auto navigation = Make(solids);
  EXPECT_FALSE(navigation->FindWay({0, 0}, {0, 3})->complete);
  EXPECT_TRUE(navigation->FindWay({0, 0}, {0, -3})->complete);
}

TEST(Navigation, WhatIsLowIsSteppedOverAndWhatHangsHighIsWalkedUnder) {
  const geometry::TriangleMesh sill = Box({-10, 0, -0.1f}, {10, 0.08f, 0.1f});
  const geometry::TriangleMesh beam = Box({-10, 2, -0.1f}, {10, 2.2f, 0.1f});
  const NavigationSolid solids[] = {{&sill, {}}, {&beam, {}}};
  EXPECT_TRUE(Make(solids)->FindWay({0, 2}, {0, -2})->complete);
  const geometry::TriangleMesh low_beam = Box({-10, 1.5f, -0.1f}, {10, 1.7f, 0.1f});
  const NavigationSolid low[] = {{&low_beam, {}}};
  EXPECT_FALSE(Make(low)->FindWay({0, 2}, {0, -2})->complete);
}

TEST(Navigation, AShutGateBlocksAndAnOpenOneLetsPass) {
  const geometry::TriangleMesh left = Box({-10, 0, -0.1f}, {-1, 2, 0.1f});
  const geometry::TriangleMesh right = Box({1, 0, -0.1f}, {10, 2, 0.1f});
  const NavigationSolid solids[] = {{&left, {}}, {&right, {}}};
  const BlockedArea areas[] = {Counter(true)};
  const auto navigation = Make(solids, areas);
  EXPECT_FALSE(navigation->FindWay({0, 2}, {0, -2})->complete);
  navigation->OpenGate(0, true);
  EXPECT_TRUE(navigation->FindWay({0, 2}, {0, -2})->complete);
  navigation->OpenGate(0, false);
  EXPECT_FALSE(navigation->FindWay({0, 2}, {0, -2})->complete);
}

TEST(Navigation, SaysWhyThereIsNoFloor) {
  NavigationOptions options;
  options.floor = {{0, 0}, {0.2f, 0}, {0, 0.2f}};
  const auto narrow = Navigation::Create(options, {}, {});
  ASSERT_FALSE(narrow.ok());
  EXPECT_NE(narrow.message().find("no place to walk"), std::string::npos) << narrow.message();
  options.floor = {{0, 0}, {1e6f, 0}, {0, 1e6f}};
  EXPECT_FALSE(Navigation::Create(options, {}, {}).ok());
}

TEST(Navigation, AWalkerComesToItsTargetAtItsSpeed) {
  const auto navigation = Make();
  const int walker = *navigation->AddWalker({-2, 0});
  navigation->Aim(walker, {2, 0}, 1.2f);
  float fastest = 0.0f;
  glm::vec2 last = navigation->position(walker);
  for (int tick = 0; tick < 8 * Navigation::kTicksPerSecond; ++tick) {
    navigation->Tick();
    const glm::vec2 now = navigation->position(walker);
    fastest = std::max(fastest, glm::distance(now, last) / kTick);
    last = now;
  }
  EXPECT_LT(glm::distance(last, glm::vec2(2, 0)), 0.05f);
  EXPECT_NEAR(fastest, 1.2f, 0.05f);
}

TEST(Navigation, CrossingWalkersKeepApart) {
  const auto navigation = Make();
  constexpr int kWalkers = 6;
  std::array<int, kWalkers> walkers;
  const auto on_circle = [](int i) {
    const float angle = 6.2831853f * static_cast<float>(i) / kWalkers;
    return 3.0f * glm::vec2(std::cos(angle), std::sin(angle));
  };
  for (int i = 0; i < kWalkers; ++i) {
    walkers[static_cast<size_t>(i)] = *navigation->AddWalker(on_circle(i));
  }
  for (int i = 0; i < kWalkers; ++i) {
    navigation->Aim(walkers[static_cast<size_t>(i)], -on_circle(i), 1.2f);
  }
  float nearest = 10.0f;
  for (int tick = 0; tick < 20 * Navigation::kTicksPerSecond; ++tick) {
    navigation->Tick();
    for (int a = 0; a < kWalkers; ++a) {
      for (int b = 0; b < a; ++b) {
        nearest = std::min(nearest, glm::distance(navigation->position(walkers[a]),
                                                  navigation->position(walkers[b])));
      }
    }
  }
  EXPECT_GT(nearest, 0.3f);
  for (int i = 0; i < kWalkers; ++i) {
    EXPECT_LT(glm::distance(navigation->position(walkers[static_cast<size_t>(i)]), -on_circle(i)),
              0.3f);
  }
}

TEST(Navigation, TheSameCallsGiveTheSamePositions) {
  const auto run = [] {
    const BlockedArea areas[] = {Counter()};
    const auto navigation = Make({}, areas);
    const int a = *navigation->AddWalker({0, 1});
    const int b = *navigation->AddWalker({0.2f, -1});
    navigation->Aim(a, {0, -1.5f}, 1.1f);
    navigation->Aim(b, {0.1f, 1.5f}, 1.3f);
    std::vector<glm::vec2> positions;
    for (int tick = 0; tick < 600; ++tick) {
      navigation->Tick();
      positions.push_back(navigation->position(a));
      positions.push_back(navigation->position(b));
    }
    return positions;
  };
  EXPECT_EQ(run(), run());
}

}  // namespace
}  // namespace lararium::stage
