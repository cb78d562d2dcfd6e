#include "player/openxr/pose_history.h"

#include <gtest/gtest.h>

namespace lararium::player {
namespace {

geometry::Rigid3 Turned(double angle, double x) {
  return {Eigen::Quaterniond(Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitY())),
          Eigen::Vector3d(x, 0.0, 0.0)};
}

TEST(PoseHistory, IsBetweenWhatItKnows) {
  PoseHistory history;
  EXPECT_FALSE(history.At(5).has_value());
  history.Add(1000, Turned(0.0, 0.0));
  history.Add(2000, Turned(0.4, 1.0));
  const geometry::Rigid3 between = history.At(1250).value();
  EXPECT_NEAR(between.translation.x(), 0.25, 1e-12);
  EXPECT_NEAR(between.rotation.angularDistance(Turned(0.1, 0.0).rotation), 0.0, 1e-9);
  EXPECT_EQ(history.At(2000)->translation.x(), 1.0);
  EXPECT_EQ(history.At(10)->translation.x(), 0.0);
  EXPECT_EQ(history.At(9999)->translation.x(), 1.0);
}

TEST(PoseHistory, ForgetsWhatIsLongAgoAndWhatGoesBack) {
  PoseHistory history;
  history.Add(0, Turned(0.0, 7.0));
  history.Add(PoseHistory::kLongest, Turned(0.0, 1.0));
  history.Add(PoseHistory::kLongest + 10, Turned(0.0, 2.0));
  EXPECT_EQ(history.At(0)->translation.x(), 1.0);
  history.Add(PoseHistory::kLongest + 5, Turned(0.0, 9.0));
  EXPECT_EQ(history.At(PoseHistory::kLongest + 10)->translation.x(), 2.0);
}

}  // namespace
}  // namespace lararium::player
