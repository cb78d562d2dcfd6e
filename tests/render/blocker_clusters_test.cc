#include "shared/render/passes/blocker_clusters.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "shared/core/random.h"

namespace lararium::render {
namespace {

std::vector<glm::vec4> RandomBalls(size_t count, uint64_t seed) {
  Random random(seed);
  std::vector<glm::vec4> balls;
  for (size_t i = 0; i < count; ++i) {
    balls.push_back({random.Uniform(-2.0, 2.0), random.Uniform(0.0, 2.0), random.Uniform(-1.0, 1.0),
                     random.Uniform(0.02, 0.1)});
  }
  return balls;
}

TEST(BlockerClusters, EveryBallIsInOneClusterThatHoldsIt) {
  for (const size_t count : {size_t{1}, size_t{8}, size_t{9}, size_t{100}, size_t{512}}) {
    const std::vector<glm::vec4> balls = RandomBalls(count, 1);
    BlockerClusters clusters;
    clusters.Build(balls);
    ASSERT_LE(clusters.cluster_count(), static_cast<int>(BlockerBlock::kMaxClusters));
    size_t next = 0;
    for (int c = 0; c < clusters.cluster_count(); ++c) {
      const BlockerBlock::Cluster& cluster = clusters.block().clusters[static_cast<size_t>(c)];
      EXPECT_EQ(cluster.extent.y, static_cast<float>(next));
      const auto end = static_cast<size_t>(cluster.extent.z);
      EXPECT_LE(end - next, 8u);
      for (; next < end; ++next) {
        const glm::vec4& ball = clusters.block().balls[next];
        EXPECT_LE(glm::distance(glm::vec3(ball), glm::vec3(cluster.merged)) + ball.w,
                  cluster.extent.x + 1e-5f);
        EXPECT_EQ(std::count(balls.begin(), balls.end(), ball), 1) << "seed 1";
      }
    }
    EXPECT_EQ(next, count);
  }
}

TEST(BlockerClusters, OneBallStandsForItself) {
  const glm::vec4 ball(1.0f, 2.0f, 3.0f, 0.5f);
  BlockerClusters clusters;
  clusters.Build({&ball, 1});
  ASSERT_EQ(clusters.cluster_count(), 1);
  EXPECT_EQ(clusters.block().clusters[0].merged, ball);
  // At the edge of its reach, the ball blocks the share that is ignored.
  const float reach = clusters.reach().high.x - ball.x;
  EXPECT_NEAR(ball.w * ball.w / (reach * reach), kLeastBlockedShare, 1e-6f);
}

TEST(BlockerClusters, WhatBlocksNothingIsLeftOut) {
  const std::vector<glm::vec4> balls = {
      {0.0f, 0.0f, 0.0f, 0.0f}, {NAN, 0.0f, 0.0f, 1.0f}, {0.0f, INFINITY, 0.0f, 1.0f}};
  BlockerClusters clusters;
  clusters.Build(balls);
  EXPECT_EQ(clusters.cluster_count(), 0);
  EXPECT_TRUE(clusters.reach().empty());
}

TEST(BlockerClusters, TooManyAreMergedAndKeepMostOfTheirDiscs) {
  for (const size_t count : {size_t{513}, size_t{2000}, size_t{10000}}) {
    const std::vector<glm::vec4> balls = RandomBalls(count, 2);
    BlockerClusters clusters;
    clusters.Build(balls);
    float all = 0.0f;
    for (const glm::vec4& ball : balls) {
      all += ball.w * ball.w;
    }
    float kept = 0.0f;
    const auto last = static_cast<size_t>(clusters.cluster_count() - 1);
    const auto end = static_cast<size_t>(clusters.block().clusters[last].extent.z);
    ASSERT_LE(end, BlockerBlock::kMaxBalls);
    for (size_t i = 0; i < end; ++i) {
      kept += clusters.block().balls[i].w * clusters.block().balls[i].w;
    }
    EXPECT_GT(kept, 0.75f * all) << count;
    EXPECT_LT(kept, 1.01f * all) << count;
  }
}

}  // namespace
}  // namespace lararium::render
