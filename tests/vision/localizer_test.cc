#include "shared/vision/localizer.h"

#include <gtest/gtest.h>

#include "tests/support/synthetic_world.h"

namespace lararium::vision {
namespace {

using geometry::Rigid3;
using test::MakeSceneDatabase;
using test::MakeSyntheticWorld;
using test::RenderView;
using test::SyntheticView;
using test::SyntheticWorld;

// Root mean square distance, in pixels, between the projections of the world's points by two poses.
double RegistrationError(const SyntheticWorld& world, const Rigid3& estimate, const Rigid3& truth) {
  double sum = 0.0;
  int count = 0;
  for (const Eigen::Vector3d& point : world.points) {
    const auto a = world.camera.Project(estimate * point);
    const auto b = world.camera.Project(truth * point);
    if (a && b) {
      sum += (*a - *b).squaredNorm();
      ++count;
    }
  }
  return std::sqrt(sum / count);
}

// Poses between and beside the cameras of the path.
std::vector<Rigid3> TestPoses() {
  std::vector<Rigid3> poses;
  for (const double angle : {-0.45, -0.21, 0.03, 0.38}) {
    for (const double distance : {3.2, 4.5}) {
      poses.push_back(test::LookAt({distance * std::sin(angle), 0.3, distance * std::cos(angle)},
                                   {0.1, -0.1, 0.2}));
    }
  }
  return poses;
}

TEST(Localizer, IsExactWithoutNoise) {
  const SyntheticWorld world = MakeSyntheticWorld({});
  const SceneDatabase database = MakeSceneDatabase(world);
  Localizer localizer(database, {});
  for (const Rigid3& truth : TestPoses()) {
    const SyntheticView view = RenderView(world, truth, {});
    const Location location = localizer.Locate(view.features, world.camera);
    ASSERT_TRUE(location.camera_from_map.has_value());
    // Points and features are kept in single precision.
    EXPECT_LT(RegistrationError(world, *location.camera_from_map, truth), 1e-4);
    EXPECT_EQ(location.reason, TrackReason::kNone);
    EXPECT_GT(location.confidence, 0.9f);
  }
}

TEST(Localizer, StaysNearTheBoundWithNoiseAndSixtyPercentOutliers) {
  const SyntheticWorld world = MakeSyntheticWorld({});
  const SceneDatabase database = MakeSceneDatabase(world);
  Localizer localizer(database, {});
  constexpr double kNoise = 0.3;
  uint64_t seed = 1;
  for (const Rigid3& truth : TestPoses()) {
    const SyntheticView view =
        RenderView(world, truth, {.noise_px = kNoise, .outlier_share = 0.6, .seed = seed++});
    const Location location = localizer.Locate(view.features, world.camera);
    ASSERT_TRUE(location.camera_from_map.has_value());
    const auto seen =
        std::count_if(view.points.begin(), view.points.end(), [](int point) { return point >= 0; });
    // Six parameters are fitted to 2 n numbers, which moves points by sqrt(6 / n) sigma on average.
    // The weights by scale do not match this noise, which allows twice that; chance allows another
    // factor of two.
    const double bound = 4.0 * kNoise * std::sqrt(6.0 / static_cast<double>(seen));
    EXPECT_LT(RegistrationError(world, *location.camera_from_map, truth), bound);
    EXPECT_GT(location.inliers, 0.9 * static_cast<double>(seen));
    EXPECT_LT(location.inliers, 1.1 * static_cast<double>(seen));
  }
}

TEST(Localizer, SaysHowFarThePoseMayBeOff) {
  const SyntheticWorld world = MakeSyntheticWorld({});
  const SceneDatabase database = MakeSceneDatabase(world);
  Localizer localizer(database, {});
  const Rigid3 truth = TestPoses()[2];
  double expected[2];
  int i = 0;
  for (const double noise : {0.1, 0.8}) {
    const SyntheticView view = RenderView(world, truth, {.noise_px = noise});
    const Location location = localizer.Locate(view.features, world.camera);
    ASSERT_TRUE(location.camera_from_map.has_value());
    const double error = RegistrationError(world, *location.camera_from_map, truth);
    EXPECT_LT(error, 2.0 * location.expected_error_px);
    expected[i++] = location.expected_error_px;
  }
  EXPECT_GT(expected[1], 3.0 * expected[0]);
}

TEST(Localizer, RepeatsItself) {
  const SyntheticWorld world = MakeSyntheticWorld({});
  const SceneDatabase database = MakeSceneDatabase(world);
  Localizer first(database, {});
  Localizer second(database, {});
  const auto poses = TestPoses();
  const SyntheticView view = RenderView(world, poses[0], {.noise_px = 0.5, .outlier_share = 0.5});
  const Location a = first.Locate(view.features, world.camera);
  // Earlier calls must not matter.
  second.Locate(RenderView(world, poses[5], {}).features, world.camera);
  const Location b = second.Locate(view.features, world.camera);
  ASSERT_TRUE(a.camera_from_map && b.camera_from_map);
  EXPECT_EQ(a.camera_from_map->translation, b.camera_from_map->translation);
  EXPECT_EQ(a.camera_from_map->rotation.coeffs(), b.camera_from_map->rotation.coeffs());
}

TEST(Localizer, FindsNoPoseFromRandomDescriptors) {
  const SyntheticWorld world = MakeSyntheticWorld({});
  const SceneDatabase database = MakeSceneDatabase(world);
  Localizer localizer(database, {});
  for (uint64_t seed = 1; seed <= 10; ++seed) {
    SyntheticView view = RenderView(world, TestPoses()[0], {.seed = seed});
    Random random(seed);
    for (Descriptor& descriptor : view.features.descriptors) {
      descriptor = test::RandomDescriptor(random);
    }
    const Location location = localizer.Locate(view.features, world.camera);
    EXPECT_FALSE(location.camera_from_map.has_value());
    EXPECT_NE(location.reason, TrackReason::kNone);
    EXPECT_EQ(location.confidence, 0.0f);
  }
}

TEST(Localizer, FindsNoPoseWhereAllMatchesAreWrong) {
  const SyntheticWorld world = MakeSyntheticWorld({});
  const SceneDatabase database = MakeSceneDatabase(world);
  Localizer localizer(database, {});
  for (uint64_t seed = 1; seed <= 10; ++seed) {
    const SyntheticView view =
        RenderView(world, TestPoses()[1], {.outlier_share = 1.0, .seed = seed});
    const Location location = localizer.Locate(view.features, world.camera);
    EXPECT_FALSE(location.camera_from_map.has_value());
    EXPECT_EQ(location.reason, TrackReason::kNoConsistentPose);
  }
}

TEST(Localizer, DoesNotChooseAmongPartsThatLookAlike) {
  const SyntheticWorld world = MakeSyntheticWorld({});
  SceneDatabase database = MakeSceneDatabase(world);
  database.lookalikes.assign(database.points.size(), 1);
  Localizer localizer(database, {});
  const Rigid3 truth = TestPoses()[2];
  const SyntheticView view = RenderView(world, truth, {.noise_px = 0.3});
  const Location location = localizer.Locate(view.features, world.camera);
  EXPECT_FALSE(location.camera_from_map.has_value());
  EXPECT_EQ(location.reason, TrackReason::kAmbiguous);

  CameraGuess guess{ExactCamera(world.camera)};
  guess.predicted = Rigid3{truth.rotation, truth.translation + Eigen::Vector3d(0.02, 0.0, 0.0)};
  const Location near = localizer.Locate(view.features, guess);
  ASSERT_TRUE(near.camera_from_map.has_value());
  EXPECT_LT(RegistrationError(world, *near.camera_from_map, truth), 1.0);
}

TEST(Localizer, LocatesByPointsThatNothingElseLooksLike) {
  const SyntheticWorld world = MakeSyntheticWorld({});
  SceneDatabase database = MakeSceneDatabase(world);
  database.lookalikes.assign(database.points.size(), 1);
  for (size_t i = 0; i < database.points.size(); i += 4) {
    database.lookalikes[i] = 0;
  }
  Localizer localizer(database, {});
  const Rigid3 truth = TestPoses()[2];
  const SyntheticView view = RenderView(world, truth, {.noise_px = 0.3});
  const Location location = localizer.Locate(view.features, world.camera);
  ASSERT_TRUE(location.camera_from_map.has_value());
  EXPECT_LT(RegistrationError(world, *location.camera_from_map, truth), 1.0);
}

TEST(Localizer, FindsNoPoseFromFewFeatures) {
  const SyntheticWorld world = MakeSyntheticWorld({});
  const SceneDatabase database = MakeSceneDatabase(world);
  Localizer localizer(database, {});
  Features few = RenderView(world, TestPoses()[0], {}).features;
  few.keypoints.resize(14);
  few.descriptors.resize(14);
  const Location location = localizer.Locate(few, world.camera);
  EXPECT_FALSE(location.camera_from_map.has_value());
  EXPECT_EQ(location.reason, TrackReason::kTooFewFeatures);
  EXPECT_EQ(localizer.Locate(Features(), world.camera).reason, TrackReason::kTooFewFeatures);
}

TEST(Localizer, RefusesInliersThatHuddleTogether) {
  const SyntheticWorld world = MakeSyntheticWorld({.points = 4000});
  const SceneDatabase database = MakeSceneDatabase(world);
  Localizer localizer(database, {});
  const Rigid3 truth = TestPoses()[3];
  const SyntheticView view = RenderView(world, truth, {.noise_px = 0.8});
  Features huddle;
  for (size_t f = 0; f < view.features.size(); ++f) {
    const Keypoint& k = view.features.keypoints[f];
    if (std::hypot(k.x - 320.0, k.y - 240.0) < 16.0) {
      huddle.keypoints.push_back(k);
      huddle.descriptors.push_back(view.features.descriptors[f]);
    }
  }
  ASSERT_GE(huddle.size(), 15u);
  const Location location = localizer.Locate(huddle, world.camera);
  EXPECT_FALSE(location.camera_from_map.has_value());
  EXPECT_EQ(location.reason, TrackReason::kNoConsistentPose);
}

}  // namespace
}  // namespace lararium::vision
