#include "editor/train/viewpoint_predictor.h"

#include <gtest/gtest.h>

#include <cmath>

#include "shared/core/random.h"
#include "shared/vision/localizer.h"
#include "tests/support/synthetic_world.h"

namespace lararium::train {
namespace {

using geometry::Rigid3;
using lararium::test::LookAt;

// A synthetic world's map whose observations have the noise of real ones.
vision::SceneDatabase MakeNoisyMap(const lararium::test::SyntheticWorld& world, double noise_px) {
  vision::SceneDatabase db = lararium::test::MakeSceneDatabase(world);
  Random random(5);
  for (vision::Observation& o : db.observations) {
    o.x += static_cast<float>(noise_px * random.Normal());
    o.y += static_cast<float>(noise_px * random.Normal());
  }
  return db;
}

TEST(ViewpointPredictor, MeasuresTheNoiseOfObservations) {
  const auto world = lararium::test::MakeSyntheticWorld({});
  for (const double noise : {0.2, 0.6}) {
    EXPECT_NEAR(ViewpointPredictor(MakeNoisyMap(world, noise)).noise_px(), noise, 0.05 * noise);
  }
}

TEST(ViewpointPredictor, ForetellsWhatTheLocalizerFinds) {
  constexpr double kNoise = 0.5;
  const auto world = lararium::test::MakeSyntheticWorld({});
  const vision::SceneDatabase db = MakeNoisyMap(world, kNoise);
  const ViewpointPredictor predictor(db);
  vision::Localizer localizer(db, {});
  for (size_t i = 1; i + 1 < world.cameras_from_world.size(); i += 3) {
    // A viewpoint between two cameras of the path, and a little nearer.
    const Eigen::Vector3d center =
        0.45 * (world.cameras_from_world[i].Center() + world.cameras_from_world[i + 1].Center());
    const Rigid3 pose = LookAt(center, Eigen::Vector3d::Zero());
    const auto view =
        lararium::test::RenderView(world, pose, {.noise_px = kNoise, .descriptor_noise = 5.0});
    const vision::Location location = localizer.Locate(view.features, world.camera);
    ASSERT_TRUE(location.camera_from_map.has_value());
    const ViewpointPrediction prediction = predictor.Predict(pose);
    EXPECT_NEAR(prediction.matches, location.inliers, 0.3 * location.inliers);
    // The localizer considers the larger uncertainty of large features, but the predictor does not.
    EXPECT_LT(prediction.error_px, 2.0 * location.expected_error_px);
    EXPECT_GT(prediction.error_px, 0.3 * location.expected_error_px);
  }
}

TEST(ViewpointPredictor, FindsNothingWhereThePlaceIsOutOfViewOrSeenFromBehind) {
  const auto world = lararium::test::MakeSyntheticWorld({});
  const ViewpointPredictor predictor(lararium::test::MakeSceneDatabase(world));
  const Eigen::Vector3d center = world.cameras_from_world[5].Center();
  EXPECT_EQ(QualityOf(predictor.Predict(LookAt(center, Eigen::Vector3d::Zero()))),
            ViewpointQuality::kGood);
  const ViewpointPrediction away = predictor.Predict(LookAt(center, 2.0 * center));
  EXPECT_EQ(QualityOf(away), ViewpointQuality::kNone);
  EXPECT_TRUE(std::isinf(away.error_px));
  // No feature is recognised from ten times as far.
  EXPECT_EQ(QualityOf(predictor.Predict(LookAt(10.0 * center, Eigen::Vector3d::Zero()))),
            ViewpointQuality::kNone);
}

TEST(ViewpointPredictor, ThinningOutALargeMapKeepsThePrediction) {
  const auto world = lararium::test::MakeSyntheticWorld({.points = 9000, .cameras = 6});
  const vision::SceneDatabase db = lararium::test::MakeSceneDatabase(world);
  const Rigid3& pose = world.cameras_from_world[3];
  size_t visible = 0;
  for (const vision::Observation& o : db.observations) {
    visible += o.keyframe == 3 ? 1 : 0;
  }
  EXPECT_NEAR(ViewpointPredictor(db).Predict(pose).matches, static_cast<double>(visible),
              0.1 * static_cast<double>(visible));
}

TEST(ViewpointPredictor, TakesAnEmptyMap) {
  vision::SceneDatabase db;
  db.camera = {640, 480, 500, 500, 319.5, 239.5};
  db.descriptor_begin = {0};
  EXPECT_EQ(QualityOf(ViewpointPredictor(db).Predict({})), ViewpointQuality::kNone);
}

}  // namespace
}  // namespace lararium::train
