#include "editor/train/mapper.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "editor/train/bundle_adjustment.h"
#include "tests/train/synthetic_world.h"

namespace lararium::train {
namespace {

using synthetic::MakeWorld;
using synthetic::World;

class CancelAtOnce : public Progress {
 public:
  void Report(std::string_view, double) override {}
  bool Cancelled() const override { return true; }
};

BundleOptions Refined(bool centre) { return {.refine_intrinsics = true, .refine_centre = centre}; }

TEST(Mapper, RecoversCamerasFromNoisyTracks) {
  const World world = MakeWorld({});
  const auto pairs = world.Pairs(6, world.camera);
  Reconstruction reconstruction = world.Unsolved(pairs, world.camera);
  NoProgress progress;
  ASSERT_TRUE(MapIncrementally(reconstruction, pairs, {}, progress, *MakeSilentLog()));
  EXPECT_EQ(reconstruction.LocatedImages().size(), world.pixels.size());
  EXPECT_LT(world.CenterError(reconstruction), 0.002);  // The cameras are at a distance of 4.
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

TEST(Mapper, ShrugsOffFalseObservations) {
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
  const double deviation =
      EstimateDeviation(reconstruction, (*anchors)[0], Refined(false)).focal_px;
  EXPECT_GT(deviation, 0.0);
  EXPECT_NEAR(reconstruction.camera().fx, world.camera.fx, 4.0 * deviation);
  EXPECT_NEAR(reconstruction.camera().fx, world.camera.fx, 6.0);
}

// The world as seen if image i was taken by cameras[camera_of_image[i]].
World TakenBy(World world,
              std::span<const geometry::CameraModel> cameras,
              std::span<const uint32_t> camera_of_image) {
  for (size_t image = 0; image < world.pixels.size(); ++image) {
    for (Eigen::Vector2d& pixel : world.pixels[image]) {
      pixel = cameras[camera_of_image[image]].PixelFromPlane(world.camera.PlaneFromPixel(pixel));
    }
  }
  return world;
}

TEST(Mapper, EstimatesTheIntrinsicsOfEachCamera) {
  const World world = MakeWorld({.images = 15, .points = 600, .arc = 1.4, .seed = 8});
  std::vector<geometry::CameraModel> cameras(3, world.camera);
  cameras[1].fx = cameras[1].fy = 0.7 * world.camera.fx;
  cameras[1].k1 = -0.08;
  cameras[2].fx = cameras[2].fy = 1.4 * world.camera.fx;
  cameras[2].k1 = 0.05;
  std::vector<uint32_t> camera_of_image;
  for (uint32_t image = 0; image < 15; ++image) {
    camera_of_image.push_back(image % 3);
  }
  std::vector<TrainingCamera> assumed;
  for (const geometry::CameraModel& camera : cameras) {
    TrainingCamera& start = assumed.emplace_back();
    start.model = camera;
    start.model.fx *= 1.06;
    start.model.fy *= 1.06;
    start.model.k1 = 0.0;
  }
  const auto pairs = world.Pairs(6, world.camera);
  Reconstruction reconstruction(assumed, camera_of_image,
                                TakenBy(world, cameras, camera_of_image).pixels,
                                BuildTracks(world.FeatureCounts(), pairs));
  MapperOptions options;
  options.refine_intrinsics = true;
  NoProgress progress;
  ASSERT_TRUE(MapIncrementally(reconstruction, pairs, options, progress, *MakeSilentLog()));
  EXPECT_EQ(reconstruction.LocatedImages().size(), 15u);
  EXPECT_LT(world.CenterError(reconstruction), 0.01);
  for (uint32_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(reconstruction.cameras()[i].model.fx, cameras[i].fx, 0.01 * cameras[i].fx);
    EXPECT_NEAR(reconstruction.cameras()[i].model.k1, cameras[i].k1, 0.02);
  }
}

TEST(Mapper, FindsThatAnImageWasTakenByAnotherCameraThanItIsSaid) {
  const World by_one = MakeWorld({.images = 12, .points = 600, .arc = 1.2, .seed = 9});
  std::vector<geometry::CameraModel> cameras(2, by_one.camera);
  cameras[1].fx = cameras[1].fy = 1.5 * by_one.camera.fx;
  std::vector<uint32_t> camera_of_image(12, 0);
  camera_of_image[5] = 1;
  const World world = TakenBy(by_one, cameras, camera_of_image);
  const auto pairs = world.Pairs(6, world.camera);
  TrainingCamera assumed;
  assumed.model = world.camera;
  assumed.assumed = true;
  Reconstruction reconstruction({assumed}, {}, world.pixels,
                                BuildTracks(world.FeatureCounts(), pairs));
  MapperOptions options;
  options.refine_intrinsics = true;
  options.tell_cameras_apart = true;
  NoProgress progress;
  ASSERT_TRUE(MapIncrementally(reconstruction, pairs, options, progress, *MakeSilentLog()));
  EXPECT_EQ(reconstruction.LocatedImages().size(), 12u);
  ASSERT_EQ(reconstruction.cameras().size(), 2u);
  EXPECT_EQ(reconstruction.CameraOf(5), 1u);
  EXPECT_EQ(reconstruction.MainCamera(), 0u);
  EXPECT_NEAR(reconstruction.camera(5).fx, cameras[1].fx, 0.01 * cameras[1].fx);
  EXPECT_LT(world.CenterError(reconstruction), 0.01);
}

TEST(Mapper, FreesAPrincipalPointThatTheImagesDetermine) {
  const World world = MakeWorld({.images = 24, .points = 800, .arc = 1.6, .seed = 6});
  geometry::CameraModel assumed = world.camera;
  assumed.cx += 9.0;
  assumed.cy -= 6.0;
  const auto pairs = world.Pairs(6, assumed);
  Reconstruction reconstruction = world.Unsolved(pairs, assumed);
  MapperOptions options;
  options.refine_intrinsics = true;
  NoProgress progress;
  const auto anchors = MapIncrementally(reconstruction, pairs, options, progress, *MakeSilentLog());
  ASSERT_TRUE(anchors);
  const bool freed = reconstruction.camera().cx != assumed.cx;
  const IntrinsicsDeviation deviation =
      EstimateDeviation(reconstruction, (*anchors)[0], Refined(freed));
  ASSERT_TRUE(freed);
  EXPECT_GT(deviation.cx_px, 0.0);
  EXPECT_NEAR(reconstruction.camera().cx, world.camera.cx, 4.0 * deviation.cx_px);
  EXPECT_NEAR(reconstruction.camera().cy, world.camera.cy, 4.0 * deviation.cy_px);
}

TEST(Mapper, SharesTheLensOfImagesThatWereTakenUprightAndLying) {
  const World world = MakeWorld({.images = 24, .points = 800, .arc = 1.6, .seed = 6});
  geometry::CameraModel assumed = world.camera;
  assumed.fx = assumed.fy = 1.06 * world.camera.fx;
  assumed.cx += 9.0;
  assumed.cy -= 6.0;
  std::vector<TrainingCamera> cameras(3);
  for (int turns = 0; turns < 3; ++turns) {
    cameras[turns].model = turns == 0 ? assumed : Turned(cameras[turns - 1].model);
    cameras[turns].quarter_turns = turns;
    // Frames have room for images of both shapes.
    const int width = cameras[turns].model.width;
    const int height = cameras[turns].model.height;
    const int side = std::max(width, height);
    cameras[turns].area = {(side - width) / 2, (side - height) / 2, width, height};
    if (turns > 0) {
      cameras[turns].lens_of = 0;
    }
  }
  for (TrainingCamera& camera : cameras) {
    camera.model.width = camera.model.height = std::max(camera.area.width, camera.area.height);
    camera.model.cx += camera.area.x;
    camera.model.cy += camera.area.y;
  }
  TrainingCamera stored;
  stored.model = world.camera;
  std::vector<uint32_t> camera_of_image;
  std::vector<std::vector<Eigen::Vector2d>> pixels = world.pixels;
  const auto turn_of = [](uint32_t image) {
    return Eigen::Quaterniond(
        Eigen::AngleAxisd(0.5 * std::numbers::pi * (image % 3), Eigen::Vector3d::UnitZ()));
  };
  for (uint32_t image = 0; image < pixels.size(); ++image) {
    camera_of_image.push_back(image % 3);
    for (Eigen::Vector2d& pixel : pixels[image]) {
      pixel = TurnedPixel(stored, cameras[image % 3], pixel);
    }
  }
  auto pairs = world.Pairs(6, assumed);
  for (VerifiedPair& pair : pairs) {
    pair.b_from_a = geometry::Rigid3{turn_of(pair.images.b), Eigen::Vector3d::Zero()} *
                    pair.b_from_a *
                    geometry::Rigid3{turn_of(pair.images.a), Eigen::Vector3d::Zero()}.Inverse();
  }
  Reconstruction reconstruction(cameras, camera_of_image, pixels,
                                BuildTracks(world.FeatureCounts(), pairs));
  MapperOptions options;
  options.refine_intrinsics = true;
  NoProgress progress;
  const auto anchors = MapIncrementally(reconstruction, pairs, options, progress, *MakeSilentLog());
  ASSERT_TRUE(anchors);
  EXPECT_EQ(reconstruction.LocatedImages().size(), 24u);
  EXPECT_LT(world.CenterError(reconstruction), 0.01);
  const auto deviations = EstimateDeviations(reconstruction, (*anchors)[0], Refined(true));
  for (uint32_t i = 0; i < 3; ++i) {
    const geometry::CameraModel truth = TurnedModel(stored, cameras[i]);
    const geometry::CameraModel& found = reconstruction.cameras()[i].model;
    EXPECT_NEAR(found.fx, truth.fx, 4.0 * deviations[i].focal_px);
    EXPECT_NEAR(found.cx, truth.cx, 4.0 * deviations[i].cx_px);
    EXPECT_NEAR(found.cy, truth.cy, 4.0 * deviations[i].cy_px);
    EXPECT_EQ(found, TurnedModel(reconstruction.cameras()[0], cameras[i]));
  }
}

TEST(Mapper, KeepsTheCentreThatAFewImagesDoNotDetermine) {
  const World world =
      MakeWorld({.images = 4, .points = 60, .arc = 0.3, .noise_px = 1.0, .seed = 7});
  const auto pairs = world.Pairs(3, world.camera);
  Reconstruction reconstruction = world.Unsolved(pairs, world.camera);
  MapperOptions options;
  options.refine_intrinsics = true;
  NoProgress progress;
  if (MapIncrementally(reconstruction, pairs, options, progress, *MakeSilentLog())) {
    EXPECT_EQ(reconstruction.camera().cx, world.camera.cx);
    EXPECT_EQ(reconstruction.camera().cy, world.camera.cy);
  }
}

// A passer-by covers two fifths of the points in the middle images.
TEST(Mapper, LeavesOutSomebodyWhoWalksBy) {
  World world = MakeWorld({.images = 16, .points = 600, .seed = 8});
  constexpr uint32_t kWalking = 240;  // Points with a lower index belong to the passer-by.
  for (uint32_t image = 0; image < world.pixels.size(); ++image) {
    std::vector<Eigen::Vector2d> pixels;
    std::vector<uint32_t> point_of;
    for (size_t f = 0; f < world.pixels[image].size(); ++f) {
      const uint32_t point = world.point_of[image][f];
      Eigen::Vector2d pixel = world.pixels[image][f];
      if (point < kWalking) {
        const Eigen::Vector3d step(0.11 * image - 0.8, 0.03 * std::sin(1.3 * image), 0.0);
        const auto moved =
            world.camera.Project(world.camera_from_world[image] * (world.points[point] + step));
        if (image < 4 || image > 11 || !moved || !world.camera.Contains(*moved)) {
          continue;
        }
        pixel = *moved;
      }
      pixels.push_back(pixel);
      point_of.push_back(point);
    }
    world.pixels[image] = pixels;
    world.point_of[image] = point_of;
  }
  const auto pairs = world.Pairs(6, world.camera);
  Reconstruction reconstruction = world.Unsolved(pairs, world.camera);
  NoProgress progress;
  ASSERT_TRUE(MapIncrementally(reconstruction, pairs, {}, progress, *MakeSilentLog()));
  EXPECT_EQ(reconstruction.LocatedImages().size(), world.pixels.size());
  EXPECT_LT(world.CenterError(reconstruction), 0.004);
  size_t walking = 0;
  for (uint32_t track = 0; track < reconstruction.tracks().size(); ++track) {
    const TrackElement& element = reconstruction.tracks()[track].front();
    walking +=
        reconstruction.HasPoint(track) && world.point_of[element.image][element.feature] < kWalking
            ? 1
            : 0;
  }
  EXPECT_LE(walking, kWalking / 50);
  EXPECT_GT(reconstruction.PointCount(), 340u);
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
