#include "editor/train/loop_closures.h"

#include <gtest/gtest.h>

namespace lararium::train {
namespace {

constexpr uint32_t kImages = 30;
constexpr int kImagePoints = 40;  // Points of one image.
constexpr double kStep = 0.2;     // Metres from image to image.
constexpr double kDepth = 3.0;
constexpr uint32_t kNeighbours = 2;

geometry::CameraModel FilmCamera() {
  geometry::CameraModel camera;
  camera.width = 640;
  camera.height = 480;
  camera.fx = camera.fy = 600.0;
  camera.cx = 319.5;
  camera.cy = 239.5;
  return camera;
}

// A camera that walks along a wall. Each image sees the points before it, and the next two images
// see them too. Feature f of image i is point (i, f) for f < kImagePoints, then come those of the
// images before it.
struct Walk {
  Reconstruction chain;
  std::vector<VerifiedPair> pairs;
};

Walk WalkAlongTheWall(const std::vector<VerifiedPair>& far) {
  std::vector<std::vector<Eigen::Vector2d>> pixels(kImages);
  std::vector<uint32_t> counts;
  Walk walk{Reconstruction(FilmCamera(), {}, {}), {}};
  const auto centre = [](uint32_t image) { return Eigen::Vector3d(kStep * image, 0.0, 0.0); };
  const auto point = [&](uint32_t image, int f) {
    return Eigen::Vector3d(centre(image) + Eigen::Vector3d(0.05 * (f % 8), 0.1 * (f / 8), kDepth));
  };
  for (uint32_t image = 0; image < kImages; ++image) {
    for (uint32_t back = 0; back <= std::min(image, kNeighbours); ++back) {
      for (int f = 0; f < kImagePoints; ++f) {
        pixels[image].push_back(*FilmCamera().Project(point(image - back, f) - centre(image)));
      }
      if (back > 0) {
        VerifiedPair& pair = walk.pairs.emplace_back();
        pair.images = {image - back, image};
        for (uint32_t f = 0; f < kImagePoints; ++f) {
          pair.matches.push_back({f, back * kImagePoints + f});
        }
      }
    }
    counts.push_back(static_cast<uint32_t>(pixels[image].size()));
  }
  walk.chain = Reconstruction(FilmCamera(), std::move(pixels), BuildTracks(counts, walk.pairs));
  for (uint32_t image = 0; image < kImages; ++image) {
    walk.chain.Locate(image, {Eigen::Quaterniond::Identity(), -centre(image)});
  }
  for (uint32_t track = 0; track < walk.chain.tracks().size(); ++track) {
    EXPECT_TRUE(walk.chain.Triangulate(track, {}));
  }
  walk.pairs.insert(walk.pairs.end(), far.begin(), far.end());
  return walk;
}

VerifiedPair Matching(uint32_t a, uint32_t b, uint32_t first_in_b) {
  VerifiedPair pair;
  pair.images = {a, b};
  for (uint32_t f = 0; f < kImagePoints; ++f) {
    pair.matches.push_back({f, first_in_b + f});
  }
  return pair;
}

TEST(LoopClosures, LeavesOutViewsOfTheNextBay) {
  const Walk walk = WalkAlongTheWall({Matching(4, 19, 0)});  // 3 m apart
  const LoopClosures closures = JudgeLoopClosures(walk.pairs, kNeighbours, walk.chain);
  EXPECT_EQ(closures.lookalikes, 1u);
  EXPECT_EQ(closures.pairs.size(), walk.pairs.size() - 1);
}

TEST(LoopClosures, KeepsViewsOfTheSamePoints) {
  // Image 10 is compared with images that follow it although they count as far apart.
  const Walk walk = WalkAlongTheWall({});
  const LoopClosures closures = JudgeLoopClosures(walk.pairs, 0, walk.chain);
  EXPECT_EQ(closures.lookalikes, 0u);
  EXPECT_EQ(closures.pairs.size(), walk.pairs.size());
}

TEST(LoopClosures, BelievesWhatTheChainCannotJudgeOnlyWithoutLookalikes) {
  VerifiedPair unknown = Matching(2, 28, 0);
  unknown.matches.resize(3);
  const Walk walk = WalkAlongTheWall({unknown});
  EXPECT_EQ(JudgeLoopClosures(walk.pairs, kNeighbours, walk.chain).pairs.size(), walk.pairs.size());
  const Walk twins = WalkAlongTheWall({unknown, Matching(4, 19, 0)});
  EXPECT_EQ(JudgeLoopClosures(twins.pairs, kNeighbours, twins.chain).pairs.size(),
            twins.pairs.size() - 2);
}

}  // namespace
}  // namespace lararium::train
