#include "editor/train/two_view.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "editor/train/pair_selection.h"
#include "shared/core/random.h"
#include "tests/train/synthetic_world.h"

namespace lararium::train {
namespace {

using test::MakeWorld;
using test::World;

// Sights of the points that both images see.
PointPairs Common(const World& world, uint32_t a, uint32_t b, bool on_plane) {
  PointPairs pairs;
  for (size_t i = 0; i < world.point_of[a].size(); ++i) {
    for (size_t j = 0; j < world.point_of[b].size(); ++j) {
      if (world.point_of[a][i] == world.point_of[b][j]) {
        const auto convert = [&](const Eigen::Vector2d& pixel) {
          return on_plane ? world.camera.PlaneFromPixel(pixel) : pixel;
        };
        pairs.a.push_back(convert(world.pixels[a][i]));
        pairs.b.push_back(convert(world.pixels[b][j]));
      }
    }
  }
  return pairs;
}

TEST(EstimateRelativePose, RecoversRotationAndDirection) {
  const World world = MakeWorld({.images = 2, .points = 200, .arc = 0.4, .noise_px = 0.0});
  const auto pose = EstimateRelativePose(Common(world, 0, 1, true), 1.0 / 600.0);
  ASSERT_TRUE(pose);
  const geometry::Rigid3 truth = world.camera_from_world[1] * world.camera_from_world[0].Inverse();
  EXPECT_LT(pose->b_from_a.rotation.angularDistance(truth.rotation), 1e-4);
  EXPECT_LT((pose->b_from_a.translation - truth.translation.normalized()).norm(), 1e-3);
  EXPECT_NEAR(pose->median_angle, 0.4, 0.05);
}

TEST(EstimateRelativePose, SeesThatACameraOnlyTurned) {
  const World world = MakeWorld({.images = 2, .points = 200, .arc = 0.0});
  const auto pose = EstimateRelativePose(Common(world, 0, 1, true), 2.0 / 600.0);
  if (pose) {
    EXPECT_LT(pose->median_angle, 0.01);
  }
}

TEST(EstimatePlanarGeometry, TellsAPlaneFromDepth) {
  const World flat = MakeWorld({.images = 2, .points = 200, .arc = 0.4, .planar = true});
  const World deep = MakeWorld({.images = 2, .points = 200, .arc = 0.4});
  EXPECT_GT(EstimatePlanarGeometry(Common(flat, 0, 1, true), 3.0 / 600.0).share, 0.95);
  EXPECT_LT(EstimatePlanarGeometry(Common(deep, 0, 1, true), 3.0 / 600.0).share, 0.5);
}

TEST(EstimatePlanarGeometry, HasTheTruePoseAmongItsPoses) {
  const World world =
      MakeWorld({.images = 2, .points = 200, .arc = 0.4, .noise_px = 0.0, .planar = true});
  const geometry::Rigid3 truth = world.camera_from_world[1] * world.camera_from_world[0].Inverse();
  const PlanarGeometry planar = EstimatePlanarGeometry(Common(world, 0, 1, true), 1.0 / 600.0);
  EXPECT_TRUE(std::any_of(planar.b_from_a.begin(), planar.b_from_a.end(), [&](const auto& pose) {
    return pose.rotation.angularDistance(truth.rotation) < 1e-4 &&
           (pose.translation - truth.translation.normalized()).norm() < 1e-3;
  }));
}

TEST(EstimateFundamental, KeepsTrueMatchesOnly) {
  const World world = MakeWorld({.images = 2, .points = 300, .arc = 0.4, .false_share = 0.15});
  const PointPairs pairs = Common(world, 0, 1, false);
  const auto fundamental = EstimateFundamental(pairs, 2.0);
  ASSERT_TRUE(fundamental);
  const double share =
      static_cast<double>(fundamental->inliers.size()) / static_cast<double>(pairs.size());
  EXPECT_GT(share, 0.6);  // 0.85 squared are true in both
  EXPECT_LT(share, 0.85);
}

TEST(EstimateFocal, AgreesOnTheTrueOne) {
  const World world = MakeWorld({.images = 8, .points = 400, .arc = 1.2});
  std::vector<Fundamental> pairs;
  for (uint32_t a = 0; a < 8; ++a) {
    for (uint32_t b = a + 1; b < std::min(8u, a + 4); ++b) {
      pairs.push_back(*EstimateFundamental(Common(world, a, b, false), 2.0));
    }
  }
  const auto focal = EstimateFocal(pairs, 640, 480);
  ASSERT_TRUE(focal);
  EXPECT_NEAR(*focal, 600.0, 60.0);
}

TEST(EstimateFocal, OfNothingIsNothing) { EXPECT_FALSE(EstimateFocal({}, 640, 480)); }

// Images of places; each place has its own descriptors.
std::vector<vision::Features> ImagesOfPlaces(const std::vector<int>& places) {
  std::vector<vision::Features> images;
  for (const int place : places) {
    Random random(static_cast<uint64_t>(place));
    Random noise(images.size() + 100);
    vision::Features& features = images.emplace_back();
    for (int i = 0; i < 60; ++i) {
      vision::Descriptor descriptor{};
      for (uint8_t& value : descriptor) {
        value = static_cast<uint8_t>(random.Below(4) == 0 ? 100 + random.Below(60) : 0);
        value = static_cast<uint8_t>(value + noise.Below(10));
      }
      features.descriptors.push_back(descriptor);
      features.keypoints.push_back({.response = 1.0f});
    }
  }
  return images;
}

TEST(SelectPairs, TakesAllOfFewImages) {
  EXPECT_EQ(SelectPairs(ImagesOfPlaces({0, 1, 2, 3}), {}).size(), 6u);
}

TEST(SelectPairs, FindsWhereTheSourceComesBack) {
  const std::vector<vision::Features> images =
      ImagesOfPlaces({0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 0, 11});
  PairOptions options;
  options.exhaustive_up_to = 2;
  options.neighbours = 2;
  options.similar = 1;
  const std::vector<ImagePair> pairs = SelectPairs(images, options);
  EXPECT_TRUE(std::binary_search(pairs.begin(), pairs.end(), ImagePair{0, 10}));
  EXPECT_TRUE(std::binary_search(pairs.begin(), pairs.end(), ImagePair{3, 5}));
  EXPECT_TRUE(std::is_sorted(pairs.begin(), pairs.end()));
  EXPECT_LE(pairs.size(), 12u * 3u);
  EXPECT_EQ(pairs, SelectPairs(images, options));
}

TEST(SelectPairs, CopesWithImagesWithoutFeatures) {
  std::vector<vision::Features> images = ImagesOfPlaces({0, 1, 2, 3});
  images[2] = {};
  PairOptions options;
  options.exhaustive_up_to = 2;
  options.neighbours = 1;
  EXPECT_GE(SelectPairs(images, options).size(), 3u);
  EXPECT_EQ(SelectPairs(std::vector<vision::Features>(4), options).size(), 6u);
}

}  // namespace
}  // namespace lararium::train
