#include "editor/train/two_view.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "editor/train/pair_selection.h"
#include "shared/core/random.h"
#include "tests/train/synthetic_world.h"

namespace lararium::train {
namespace {

using synthetic::MakeWorld;
using synthetic::World;

// Observations of the points that both images see.
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
  EXPECT_GT(share, 0.6);  // A share of 0.85 squared is true in both images.
  EXPECT_LT(share, 0.85);
}

TEST(EstimateFocal, AgreesOnTheTrueOne) {
  const World world = MakeWorld({.images = 8, .points = 400, .arc = 1.2});
  std::vector<Fundamental> pairs;
  for (uint32_t a = 0; a < 8; ++a) {
    for (uint32_t b = a + 1; b < std::min(8u, a + 4); ++b) {
      pairs.push_back(*EstimateFundamental(Common(world, a, b, false), 2.0));
      Eigen::Matrix3d pixel_from_share;
      pixel_from_share << 640, 0, 319.5, 0, 640, 239.5, 0, 0, 1;
      pairs.back().matrix = pixel_from_share.transpose() * pairs.back().matrix * pixel_from_share;
    }
  }
  const auto focal = EstimateFocal(pairs);
  ASSERT_TRUE(focal);
  EXPECT_NEAR(640.0 * *focal, 600.0, 60.0);
}

TEST(EstimateFocal, OfNothingIsNothing) { EXPECT_FALSE(EstimateFocal({})); }

// Images of a long wall; each shows 60 features, beginning with the one given by its start.
std::vector<vision::Features> ImagesOfWall(const std::vector<int>& starts) {
  std::vector<vision::Features> images;
  for (const int start : starts) {
    Random noise(images.size() + 100);
    vision::Features& features = images.emplace_back();
    for (int i = start; i < start + 60; ++i) {
      Random random(static_cast<uint64_t>(i));
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

// A walk along the wall and back.
std::vector<int> ThereAndBack() {
  std::vector<int> starts;
  for (int i = 0; i < 40; ++i) {
    starts.push_back(12 * std::min(i, 39 - i));
  }
  return starts;
}

bool Contains(const std::vector<ImagePair>& pairs, uint32_t a, uint32_t b) {
  return std::binary_search(pairs.begin(), pairs.end(), ImagePair{std::min(a, b), std::max(a, b)});
}

// Options with which images are not all matched with one another.
PairOptions Choosing() {
  PairOptions options;
  options.exhaustive_up_to = 25;
  return options;
}

TEST(SelectPairs, TakesAllOfFewImages) {
  EXPECT_EQ(SelectPairs(ImagesOfWall({0, 100, 200, 300}), {}).pairs.size(), 6u);
}

TEST(SelectPairs, TakesNeighboursInAVideoAndWhereItComesBack) {
  const std::vector<vision::Features> images = ImagesOfWall(ThereAndBack());
  const std::vector<ImagePair> pairs = SelectPairs(images, Choosing()).pairs;
  for (uint32_t i = 0; i + 2 < images.size(); ++i) {
    EXPECT_TRUE(Contains(pairs, i, i + 1)) << i;
    EXPECT_TRUE(Contains(pairs, i, i + 2)) << i;
  }
  for (uint32_t i = 0; i < 15; ++i) {  // The same view on the way back.
    EXPECT_TRUE(Contains(pairs, i, 39 - i)) << i;
  }
  EXPECT_TRUE(std::is_sorted(pairs.begin(), pairs.end()));
  EXPECT_LT(pairs.size(), images.size() * 9);
  EXPECT_EQ(pairs, SelectPairs(images, Choosing()).pairs);
}

TEST(SelectPairs, FindsWhatBelongsTogetherInAShuffledHeap) {
  const std::vector<int> starts = ThereAndBack();
  std::vector<int> shuffled;
  for (size_t i = 0; i < starts.size(); ++i) {
    shuffled.push_back(starts[(17 * i + 5) % starts.size()]);  // 17 and 40 have no common factor.
  }
  PairOptions options = Choosing();
  options.similar_unordered = 8;
  const std::vector<ImagePair> pairs = SelectPairs(ImagesOfWall(shuffled), options).pairs;
  for (uint32_t i = 0; i < shuffled.size(); ++i) {
    for (uint32_t j = i + 1; j < shuffled.size(); ++j) {
      if (std::abs(shuffled[i] - shuffled[j]) <= 12) {
        EXPECT_TRUE(Contains(pairs, i, j)) << shuffled[i] << " " << shuffled[j];
      }
    }
  }
  EXPECT_LT(pairs.size(), 40u * 8u);
}

TEST(SelectPairs, CopesWithImagesWithoutFeatures) {
  std::vector<vision::Features> images = ImagesOfWall(ThereAndBack());
  images[2] = {};
  EXPECT_TRUE(Contains(SelectPairs(images, Choosing()).pairs, 1, 2));
  EXPECT_LE(SelectPairs(std::vector<vision::Features>(30), Choosing()).pairs.size(),
            30u * 29u / 2u);
}

TEST(EstimateTurning, LeavesNothingForATurnAndNotForASidestep) {
  Random random(5);
  PointPairs turned;
  PointPairs moved;
  const Eigen::Matrix3d rotation =
      Eigen::AngleAxisd(0.4, Eigen::Vector3d(0.2, 1.0, -0.3).normalized()).toRotationMatrix();
  for (int i = 0; i < 50; ++i) {
    const Eigen::Vector3d point{random.Uniform(-1, 1), random.Uniform(-1, 1), random.Uniform(3, 5)};
    turned.a.push_back(point.hnormalized());
    turned.b.push_back((rotation * point).hnormalized());
    moved.a.push_back(point.hnormalized());
    moved.b.push_back((rotation * (point + Eigen::Vector3d(0.5, 0.0, 0.0))).hnormalized());
  }
  EXPECT_LT(EstimateTurning(turned).median_angle, 1e-9);
  EXPECT_GT(EstimateTurning(moved).median_angle, 0.005);
}

}  // namespace
}  // namespace lararium::train
