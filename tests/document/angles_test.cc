#include "editor/document/angles.h"

#include <gtest/gtest.h>

#include <numbers>

namespace lararium::editor {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

TEST(HeadingTiltRoll, GivesBackWhatWasTyped) {
  for (const double heading : {-3.0, -0.4, 0.0, 1.2}) {
    for (const double tilt : {-1.5, 0.0, 0.7}) {
      for (const double roll : {-2.0, 0.0, 0.3}) {
        const Vector3d angles(heading, tilt, roll);
        EXPECT_TRUE((HeadingTiltRoll(FromHeadingTiltRoll(angles)) - angles).norm() < 1e-9);
      }
    }
  }
}

TEST(HeadingTiltRoll, KeepsTheRotationAtTheEndsOfTilt) {
  for (const double tilt : {-0.5 * std::numbers::pi, 0.5 * std::numbers::pi}) {
    const Quaterniond rotation = FromHeadingTiltRoll({0.8, tilt, 0.5});
    const Quaterniond again = FromHeadingTiltRoll(HeadingTiltRoll(rotation));
    EXPECT_NEAR(rotation.angularDistance(again), 0.0, 1e-6);
  }
}

TEST(HeadingTiltRoll, HeadingIsAboutTheUpAxis) {
  const Quaterniond quarter(Eigen::AngleAxisd(0.5 * std::numbers::pi, Vector3d::UnitY()));
  EXPECT_TRUE(HeadingTiltRoll(quarter).isApprox(Vector3d(0.5 * std::numbers::pi, 0, 0), 1e-9));
}

}  // namespace
}  // namespace lararium::editor
