#include "editor/train/map_statistics.h"

#include <gtest/gtest.h>

#include <cmath>

#include "shared/core/random.h"
#include "tests/support/synthetic_world.h"

namespace lararium::train {
namespace {

using vision::SceneDatabase;

SceneDatabase StatisticsMap(int points, int cameras = 10) {
  return test::MakeSceneDatabase(test::MakeSyntheticWorld({.points = points, .cameras = cameras}));
}

TEST(MapStatistics, ErrorIsTheMeanDistanceOverAPointsObservations) {
  SceneDatabase db = StatisticsMap(40);
  float moved = 0.0f;
  uint32_t seen = 0;
  for (vision::Observation& o : db.observations) {
    if (o.point == 7) {
      ++seen;
      o.x += 3.0f * static_cast<float>(seen);
      o.y += 4.0f * static_cast<float>(seen);
      moved += 5.0f * static_cast<float>(seen);
    }
  }
  const MapStatistics statistics = MeasureStatistics(db);
  ASSERT_GT(seen, 2u);
  EXPECT_EQ(statistics.ViewsOf(7), seen);
  EXPECT_NEAR(statistics.point_error_px[7], moved / static_cast<float>(seen), 1e-3);
  EXPECT_NEAR(statistics.point_error_px[8], 0.0, 1e-3);
}

TEST(ErrorQuantilePx, IsNotExceededByThatShareOfTheObservations) {
  SceneDatabase db = StatisticsMap(30);
  ASSERT_GT(db.observations.size(), 100u);
  for (size_t i = 0; i < db.observations.size(); ++i) {  // Errors of 0, 1, 2, ... pixels.
    db.observations[i].y += static_cast<float>(i);
  }
  const auto count = static_cast<double>(db.observations.size());
  EXPECT_NEAR(ErrorQuantilePx(db, 0.95), std::ceil(0.95 * count) - 1.0, 0.01);
  EXPECT_NEAR(ErrorQuantilePx(db, 0.0), 0.0, 0.01);
  EXPECT_NEAR(ErrorQuantilePx(db, 1.0), count - 1.0, 0.01);
  db.observations.clear();
  EXPECT_EQ(ErrorQuantilePx(db, 0.95), 0.0);
}

TEST(MapStatistics, APointThatNobodySawHasNoError) {
  SceneDatabase db = StatisticsMap(10);
  std::erase_if(db.observations, [](const vision::Observation& o) { return o.point == 3; });
  const MapStatistics statistics = MeasureStatistics(db);
  EXPECT_LT(statistics.point_error_px[3], 0.0f);
  EXPECT_EQ(statistics.ViewsOf(3), 0u);
  EXPECT_GE(statistics.point_error_px[4], 0.0f);
}

TEST(MapStatistics, ObservationsOfAPointAreItsObservations) {
  const SceneDatabase db = StatisticsMap(25);
  const MapStatistics statistics = MeasureStatistics(db);
  size_t all = 0;
  for (uint32_t point = 0; point < db.points.size(); ++point) {
    for (const uint32_t observation : statistics.ObservationsOf(point)) {
      EXPECT_EQ(db.observations[observation].point, point);
      ++all;
    }
  }
  EXPECT_EQ(all, db.observations.size());
}

TEST(MapStatistics, KeyframesCountWhatTheyObserve) {
  SceneDatabase db = StatisticsMap(30);
  std::erase_if(db.observations, [](const vision::Observation& o) { return o.keyframe == 2; });
  for (vision::Observation& o : db.observations) {
    o.x += o.keyframe == 5 ? 2.0f : 0.0f;
  }
  const MapStatistics statistics = MeasureStatistics(db);
  EXPECT_EQ(statistics.keyframe_points[2], 0u);
  EXPECT_LT(statistics.keyframe_error_px[2], 0.0f);
  EXPECT_NEAR(statistics.keyframe_error_px[5], 2.0, 1e-3);
}

TEST(MapStatistics, OfOneKeyframeMoreThatObservesNothingAreAsIfMeasured) {
  SceneDatabase db = StatisticsMap(30);
  MapStatistics statistics = MeasureStatistics(db);
  vision::Keyframe added = db.keyframes.back();
  added.frame_index += 1;
  AddUnobserved(added.session, statistics);
  db.keyframes.push_back(added);
  const MapStatistics measured = MeasureStatistics(db);
  EXPECT_EQ(statistics.keyframe_points, measured.keyframe_points);
  EXPECT_EQ(statistics.keyframe_error_px, measured.keyframe_error_px);
  EXPECT_EQ(statistics.session_keyframes, measured.session_keyframes);
  EXPECT_EQ(statistics.point_error_px, measured.point_error_px);
}

TEST(MapStatistics, TellsTheOnlySessionOfAPoint) {
  SceneDatabase db = StatisticsMap(4);
  db.session_masks = {1u, 4u, 5u, 0x80000000u};
  const MapStatistics statistics = MeasureStatistics(db);
  EXPECT_EQ(statistics.session_points[0], 2u);
  EXPECT_EQ(statistics.session_points[2], 2u);
  EXPECT_EQ(statistics.session_points[1], 0u);
  EXPECT_EQ(statistics.session_keyframes[0], db.keyframes.size());
  EXPECT_EQ(statistics.point_session, (std::vector<uint8_t>{0, 2, kNoSingleSession, 31}));
}

TEST(MapStatistics, SigmaIsTheNoiseOfTheObservations) {
  SceneDatabase db = StatisticsMap(600, 12);
  Random random(4);
  for (vision::Observation& o : db.observations) {
    o.x += static_cast<float>(0.7 * random.Normal());
    o.y += static_cast<float>(0.7 * random.Normal());
  }
  // The points were not fitted to the noise here, so they used no degrees of freedom.
  const double freed = 1.0 - 3.0 / (2.0 * static_cast<double>(db.observations.size()) / 600.0);
  EXPECT_NEAR(MeasureStatistics(db).sigma_px * std::sqrt(freed), 0.7, 0.02);
}

// Triangulates a point from noisy observations, by one Gauss-Newton step from the exact position.
Eigen::Vector3d Triangulated(const SceneDatabase& db, uint32_t point, Random& random, double px) {
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  const Eigen::Vector3d at = db.points[point].cast<double>();
  for (const vision::Observation& o : db.observations) {
    if (o.point != point) {
      continue;
    }
    const geometry::Rigid3& pose = db.keyframes[o.keyframe].camera_from_map;
    Eigen::Matrix<double, 2, 3> jacobian;
    for (int axis = 0; axis < 3; ++axis) {
      const Eigen::Vector3d h = 1e-5 * Eigen::Vector3d::Unit(axis);
      jacobian.col(axis) =
          (*db.camera.Project(pose * (at + h)) - *db.camera.Project(pose * (at - h))) / 2e-5;
    }
    information += jacobian.transpose() * jacobian;
    gradient += jacobian.transpose() * Eigen::Vector2d{px * random.Normal(), px * random.Normal()};
  }
  return at + information.ldlt().solve(gradient);
}

TEST(DistanceDeviation, IsHowMuchTriangulatedDistancesScatter) {
  const SceneDatabase db = StatisticsMap(20);
  MapStatistics statistics = MeasureStatistics(db);
  statistics.sigma_px = 0.5;
  const double expected = *DistanceDeviation(db, statistics, 2, 11);
  Random random(8);
  constexpr int kTrials = 2000;
  const double exact = (db.points[2] - db.points[11]).cast<double>().norm();
  double squares = 0.0;
  for (int i = 0; i < kTrials; ++i) {
    const double distance =
        (Triangulated(db, 2, random, 0.5) - Triangulated(db, 11, random, 0.5)).norm();
    squares += (distance - exact) * (distance - exact);
  }
  EXPECT_NEAR(std::sqrt(squares / kTrials), expected, 0.06 * expected);
}

TEST(DistanceDeviation, IsUnknownWhereOneImageSawAPoint) {
  SceneDatabase db = StatisticsMap(20);
  std::erase_if(db.observations,
                [](const vision::Observation& o) { return o.point == 2 && o.keyframe != 4; });
  const MapStatistics statistics = MeasureStatistics(db);
  EXPECT_FALSE(DistanceDeviation(db, statistics, 2, 11).has_value());
  EXPECT_FALSE(DistanceDeviation(db, statistics, 11, 11).has_value());
}

}  // namespace
}  // namespace lararium::train
