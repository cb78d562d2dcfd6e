#include "editor/train/mapper.h"

#include <gtest/gtest.h>

#include "editor/train/bundle_adjustment.h"
#include "tests/train/synthetic_world.h"

namespace lararium::train {
namespace {

using test::MakeWorld;
using test::World;

class CancelAtOnce : public Progress {
 public:
  void Report(std::string_view, double) override {}
  bool Cancelled() const override { return true; }
};

TEST(Mapper, RecoversCamerasFromNoisyTracks) {
  const World world = MakeWorld({});
  const auto pairs = world.Pairs(6, world.camera);
  Reconstruction reconstruction = world.Unsolved(pairs, world.camera);
  NoProgress progress;
  ASSERT_TRUE(MapIncrementally(reconstruction, pairs, {}, progress, *MakeSilentLog()));
  EXPECT_EQ(reconstruction.LocatedImages().size(), world.pixels.size());
  EXPECT_LT(world.CenterError(reconstruction), 0.002);  // at a distance of 4
  EXPECT_GT(reconstruction.PointCount(), world.points.size() * 95 / 100);
}

TEST(Mapper, IsExactWithoutNoise) {
  const World world = MakeWorld({.noise_px = 0.0});
  const auto pairs = world.Pairs(6, world.camera);
  Reconstruction reconstruction = world.Unsolved(pairs, world.camera);
  NoProgress progress;
  ASSERT_TRUE(MapIncrementally(reconstruction, pairs, {}, progress, *MakeSilentLog()));
  EXPECT_LT(world.CenterError(reconstruction), 1e-6);
}

TEST(Mapper, ShrugsOffFalseSights) {
  const World world = MakeWorld({.false_share = 0.1, .seed = 3});
  const auto pairs = world.Pairs(6, world.camera);
  Reconstruction reconstruction = world.Unsolved(pairs, world.camera);
  NoProgress progress;
  ASSERT_TRUE(MapIncrementally(reconstruction, pairs, {}, progress, *MakeSilentLog()));
  EXPECT_EQ(reconstruction.LocatedImages().size(), world.pixels.size());
  EXPECT_LT(world.CenterError(reconstruction), 0.003);
}

TEST(Mapper, RecoversCamerasBeforeAPlane) {
  const World world = MakeWorld({.planar = true, .seed = 4});
  const auto pairs = world.Pairs(6, world.camera);
  Reconstruction reconstruction = world.Unsolved(pairs, world.camera);
  NoProgress progress;
  ASSERT_TRUE(MapIncrementally(reconstruction, pairs, {}, progress, *MakeSilentLog()));
  EXPECT_EQ(reconstruction.LocatedImages().size(), world.pixels.size());
  EXPECT_LT(world.CenterError(reconstruction), 0.01);
}

TEST(Mapper, RefusesACameraThatOnlyTurns) {
  const World world = MakeWorld({.arc = 0.0});
  const auto pairs = world.Pairs(6, world.camera);
  Reconstruction reconstruction = world.Unsolved(pairs, world.camera);
  NoProgress progress;
  EXPECT_FALSE(MapIncrementally(reconstruction, pairs, {}, progress, *MakeSilentLog()));
  EXPECT_TRUE(reconstruction.LocatedImages().empty());
}

TEST(Mapper, EstimatesAWrongFocalLength) {
  const World world = MakeWorld({.images = 16, .points = 600, .arc = 1.4, .seed = 5});
  geometry::CameraModel assumed = world.camera;
  assumed.fx = assumed.fy = 660.0;
  const auto pairs = world.Pairs(6, assumed);
  Reconstruction reconstruction = world.Unsolved(pairs, assumed);
  MapperOptions options;
  options.refine_intrinsics = true;
  NoProgress progress;
  const auto anchors = MapIncrementally(reconstruction, pairs, options, progress, *MakeSilentLog());
  ASSERT_TRUE(anchors);
  const double deviation = FocalDeviation(reconstruction, (*anchors)[0]);
  EXPECT_GT(deviation, 0.0);
  EXPECT_NEAR(reconstruction.camera().fx, world.camera.fx, 4.0 * deviation);
  EXPECT_NEAR(reconstruction.camera().fx, world.camera.fx, 6.0);
}

TEST(Mapper, StopsWhenCancelled) {
  const World world = MakeWorld({.images = 4});
  const auto pairs = world.Pairs(3, world.camera);
  Reconstruction reconstruction = world.Unsolved(pairs, world.camera);
  CancelAtOnce progress;
  EXPECT_FALSE(MapIncrementally(reconstruction, pairs, {}, progress, *MakeSilentLog()));
}

}  // namespace
}  // namespace lararium::train
