#include "editor/panels/viewport/orbit_keys.h"

#include <gtest/gtest.h>

namespace lararium::panels {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

const Vector2d kView(800.0, 600.0);

TEST(OrbitKeys, ArrowsGoRoundTheTargetInTheDirectionThatTheySay) {
  const struct {
    KeyAction action;
    Vector3d towards;  // Camera axes: x right, y down.
  } kArrows[] = {{KeyAction::kOrbitLeft, {-1, 0, 0}},
                 {KeyAction::kOrbitRight, {1, 0, 0}},
                 {KeyAction::kOrbitUp, {0, -1, 0}},
                 {KeyAction::kOrbitDown, {0, 1, 0}}};
  for (const auto& arrow : kArrows) {
    const OrbitCamera before;
    for (const bool shift : {false, true}) {
      OrbitCamera orbit = before;
      ASSERT_TRUE(OrbitByKey(arrow.action, shift, kView, orbit));
      const Vector3d moved = before.CameraFromWorld() * orbit.CameraFromWorld().Center();
      EXPECT_GT(moved.dot(arrow.towards), 0.1) << static_cast<int>(arrow.action);
      EXPECT_EQ(orbit.target == before.target, !shift) << "with Shift it moves in place of turning";
      EXPECT_EQ(orbit.distance, before.distance);
    }
  }
}

TEST(OrbitKeys, SeventyTwoStepsAreOnceAroundAndTheWayBackIsTheSame) {
  const OrbitCamera before;
  OrbitCamera orbit = before;
  for (int i = 0; i < 72; ++i) {
    OrbitByKey(KeyAction::kOrbitRight, false, kView, orbit);
  }
  EXPECT_NEAR(orbit.azimuth, before.azimuth, 1e-9);
  OrbitByKey(KeyAction::kComeNearer, false, kView, orbit);
  EXPECT_LT(orbit.distance, before.distance);
  OrbitByKey(KeyAction::kGoFurther, false, kView, orbit);
  EXPECT_NEAR(orbit.distance, before.distance, 1e-9);
  OrbitByKey(KeyAction::kOrbitUp, true, kView, orbit);
  OrbitByKey(KeyAction::kOrbitDown, true, kView, orbit);
  EXPECT_LT((orbit.target - before.target).norm(), 1e-9);
}

TEST(OrbitKeys, OtherActionsLeaveTheOrbitAlone) {
  OrbitCamera orbit;
  EXPECT_FALSE(OrbitByKey(KeyAction::kNone, false, kView, orbit));
  EXPECT_FALSE(OrbitByKey(KeyAction::kNudgeLeft, false, kView, orbit));
  EXPECT_EQ(orbit.azimuth, OrbitCamera().azimuth);
}

}  // namespace
}  // namespace lararium::panels
