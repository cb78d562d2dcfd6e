#include "shared/audio/obstruction.h"

#include <gtest/gtest.h>

namespace lararium::audio {
namespace {

// A wall two metres wide and high, one metre in front of the ear at the origin.
stage::Occluder Wall() {
  stage::Occluder wall;
  wall.mesh.positions = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}};
  wall.mesh.indices = {0, 1, 2, 0, 2, 3};
  return wall;
}

TEST(SoundBlockers, WhatIsBehindAWallIsObstructed) {
  const stage::Occluder walls[] = {Wall()};
  const SoundBlockers blockers(walls);
  EXPECT_EQ(blockers.Obstruction({0, 0, 0}, {0, 0, -3}), 1.0f);
  EXPECT_EQ(blockers.Obstruction({0, 0, 0}, {0, 0, -0.5f}), 0.0f);
  EXPECT_EQ(blockers.Obstruction({0, 0, 0}, {5, 0, -3}), 0.0f);
}

TEST(SoundBlockers, AnEdgeHidesASourceByAndBy) {
  const stage::Occluder walls[] = {Wall()};
  const SoundBlockers blockers(walls);
  const float at_edge = blockers.Obstruction({0, 0, 0}, {3.0f, 0, -3});  // Past the wall's edge.
  EXPECT_GT(at_edge, 0.0f);
  EXPECT_LT(at_edge, 1.0f);
  EXPECT_GE(blockers.Obstruction({0, 0, 0}, {2.9f, 0, -3}), at_edge);
}

TEST(SoundBlockers, CurtainsLetSoundThrough) {
  stage::Occluder curtain = Wall();
  curtain.blocks_sound = false;
  const SoundBlockers blockers(std::span(&curtain, 1));
  EXPECT_EQ(blockers.Obstruction({0, 0, 0}, {0, 0, -3}), 0.0f);
}

TEST(SoundBlockers, AMeshOfAnotherScaleIsWhereItStands) {
  stage::Occluder wall = Wall();
  wall.stage_from_mesh.scale = 0.1;
  wall.stage_from_mesh.translation = {0, 0, -1};
  const SoundBlockers blockers(std::span(&wall, 1));
  EXPECT_EQ(blockers.Obstruction({0, 0, 0}, {0, 0, -1.05f}), 0.0f);
  EXPECT_GT(blockers.Obstruction({0, 0, -1.0f}, {0, 0, -1.4f}), 0.0f);
  EXPECT_EQ(blockers.Obstruction({0, 0, 0}, {1, 0, -3}), 0.0f);
}

TEST(SoundBlockers, WhatLiesOnASurfaceIsNotHiddenByIt) {
  const stage::Occluder walls[] = {Wall()};
  const SoundBlockers blockers(walls);
  EXPECT_EQ(blockers.Obstruction({0, 0, 0}, {0, 0, -1.02f}), 0.0f);
  EXPECT_EQ(blockers.Obstruction({0, 0, 0}, {0, 0, 0}), 0.0f);
}

}  // namespace
}  // namespace lararium::audio
