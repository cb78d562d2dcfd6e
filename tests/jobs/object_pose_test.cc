#include "editor/jobs/object_pose.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace lararium::editor {
namespace {

Eigen::Quaterniond Turned(double degrees) {
  return Eigen::Quaterniond(
      Eigen::AngleAxisd(degrees * std::numbers::pi / 180.0, Eigen::Vector3d::UnitY()));
}

TEST(PlaceObject, WritesMillimetresAndTenthsOfADegree) {
  ObjectDocument object;
  PlaceObject(Turned(34.56), {1.23456, -0.0001, 2.0}, object);
  EXPECT_TRUE(object.position.isApprox(Eigen::Vector3d(1.235, 0.0, 2.0), 1e-12));
  EXPECT_FALSE(std::signbit(object.position.y()));
  EXPECT_NEAR(object.heading, 34.6, 1e-9);
  EXPECT_LT(StageFromObject(object).rotation.angularDistance(Turned(34.6)), 1e-9);
}

TEST(PlaceObject, KeepsAHeadingThatDidNotTurnAsItWasWritten) {
  ObjectDocument object;
  object.heading = 270.0;
  PlaceObject(Turned(-90.0), {1.0, 0.0, 0.0}, object);
  EXPECT_EQ(object.heading, 270.0);
}

TEST(PlaceObject, OfATiltItsHeadingCounts) {
  ObjectDocument object;
  const Eigen::Quaterniond tilt(Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitX()));
  PlaceObject(Turned(50.0) * tilt, {0.0, 0.0, 0.0}, object);
  EXPECT_NEAR(object.heading, 50.0, 1e-9);
}

TEST(InitialPose, IsWhereTheProjectHasTheObject) {
  ObjectDocument object;
  object.position = {1.0, 2.0, 3.0};
  object.heading = 90.0;
  const stage::Pose pose = InitialPose(object);
  EXPECT_EQ(pose.position, glm::vec3(1.0f, 2.0f, 3.0f));
  const glm::vec3 ahead = pose.rotation * glm::vec3(0.0f, 0.0f, -1.0f);
  EXPECT_NEAR(ahead.x, -1.0f, 1e-6f);
}

}  // namespace
}  // namespace lararium::editor
