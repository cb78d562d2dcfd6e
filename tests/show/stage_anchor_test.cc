#include "shared/show/stage_anchor.h"

#include <gtest/gtest.h>

namespace lararium::show {
namespace {

using geometry::Rigid3;

Rigid3 RoomFromStage(double x, double yaw = 0.0) {
  return {Eigen::Quaterniond(Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitY())),
          Eigen::Vector3d(x, 0.0, 0.0)};
}

double PlaceOf(const StageAnchor& anchor) { return anchor.room_from_stage()->translation.x(); }

TEST(StageAnchor, IsNowhereAndShowsNobodyBeforeItIsSeen) {
  const StageAnchor anchor;
  EXPECT_FALSE(anchor.room_from_stage().has_value());
  EXPECT_EQ(anchor.Opacity(5.0), 0.0f);
}

TEST(StageAnchor, StandsWhereItIsSeenFirst) {
  StageAnchor anchor;
  anchor.Observe(RoomFromStage(1.0, 0.5), 0.0);
  EXPECT_EQ(PlaceOf(anchor), 1.0);
  EXPECT_NEAR(anchor.room_from_stage()->rotation.angularDistance(RoomFromStage(0.0, 0.5).rotation),
              0.0, 1e-9);
}

TEST(StageAnchor, TremblesLessThanWhatIsSeen) {
  StageAnchor anchor;
  for (int i = 0; i < 120; ++i) {
    anchor.Observe(RoomFromStage(i % 2 == 0 ? 0.01 : -0.01, i % 2 == 0 ? 0.01 : -0.01), i / 30.0);
    if (i > 60) {
      EXPECT_LT(std::abs(PlaceOf(anchor)), 0.002);
      EXPECT_LT(anchor.room_from_stage()->rotation.angularDistance(RoomFromStage(0.0).rotation),
                0.002);
    }
  }
}

TEST(StageAnchor, ComesToWhereItIsSeenWhateverTheRate) {
  for (const double rate : {10.0, 30.0, 60.0}) {
    StageAnchor anchor;
    anchor.Observe(RoomFromStage(0.0), 0.0);
    for (int i = 1; i <= 0.4 * rate; ++i) {
      anchor.Observe(RoomFromStage(0.1, 0.05), i / rate);
    }
    EXPECT_NEAR(PlaceOf(anchor), 0.1 * (1.0 - std::exp(-1.0)), 0.002) << rate;
  }
}

TEST(StageAnchor, LeapsOnlyToWhereItIsSeenAgainAndAgain) {
  StageAnchor anchor;
  anchor.Observe(RoomFromStage(0.0), 0.0);
  anchor.Observe(RoomFromStage(2.0), 0.1);
  anchor.Observe(RoomFromStage(0.0), 0.2);
  anchor.Observe(RoomFromStage(2.0), 0.3);
  EXPECT_LT(PlaceOf(anchor), 0.01) << "single errors";
  anchor.Observe(RoomFromStage(2.0), 0.4);
  anchor.Observe(RoomFromStage(2.0), 0.5);
  EXPECT_EQ(PlaceOf(anchor), 2.0);
}

TEST(StageAnchor, HoldsPeopleForAWhileWithoutBeingSeenAndThenLetsThemFade) {
  StageAnchor anchor;
  anchor.Observe(RoomFromStage(0.0), 100.0);
  EXPECT_EQ(anchor.Opacity(100.1), 1.0f);
  EXPECT_EQ(anchor.Opacity(109.0), 1.0f);
  EXPECT_NEAR(anchor.Opacity(110.5), 0.5f, 1e-4f);
  EXPECT_EQ(anchor.Opacity(112.0), 0.0f);
  anchor.Observe(RoomFromStage(0.0), 120.0);
  EXPECT_EQ(anchor.Opacity(120.0), 1.0f);
}

TEST(StageAnchor, HoldsPeopleForeverWhereNothingMoreIsMeasured) {
  StageAnchor anchor(StageAnchor::kForever);
  EXPECT_EQ(anchor.Opacity(0.0), 0.0f);
  anchor.Observe(RoomFromStage(0.0), 100.0);
  EXPECT_EQ(anchor.Opacity(100000.0), 1.0f);
}

}  // namespace
}  // namespace lararium::show
