#include "shared/light/key_poses.h"

#include <gtest/gtest.h>

#include "tests/light/sh_test_support.h"

namespace lararium::light {
namespace {

constexpr size_t kReceivers = 19;
constexpr int kCount = 16;

ShRows RandomLogs(Random& random) {
  ShRows rows(kCount, kReceivers);
  for (int k = 0; k < kCount; ++k) {
    for (size_t i = 0; i < kReceivers; ++i) {
      rows.at(k, i) = static_cast<float>(0.3 * random.Normal());
    }
  }
  return rows;
}

std::vector<ShRows> RandomKeys(Random& random, int poses) {
  std::vector<ShRows> keys;
  for (int i = 0; i < poses; ++i) {
    keys.push_back(RandomLogs(random));
  }
  return keys;
}

// (1 - share) a + share b.
ShRows Between(const ShRows& a, const ShRows& b, float share) {
  ShRows rows(kCount, kReceivers);
  for (int k = 0; k < kCount; ++k) {
    for (size_t i = 0; i < kReceivers; ++i) {
      rows.at(k, i) = (1.0f - share) * a.at(k, i) + share * b.at(k, i);
    }
  }
  return rows;
}

std::vector<float> Weights(const std::vector<ShRows>& keys,
                           const ShRows& now,
                           std::span<const float> prior = {}) {
  std::vector<float> weights(kReceivers * kMaxKeyPoses, -1.0f);
  KeyPoseWeights(keys, now, prior, {0, kReceivers}, weights);
  return weights;
}

TEST(KeyPoses, WeightsArePositiveAndSumToOne) {
  Random random(81);
  for (const int poses : {1, 2, 5, 8}) {
    const std::vector<ShRows> keys = RandomKeys(random, poses);
    const std::vector<float> weights = Weights(keys, RandomLogs(random));
    for (size_t i = 0; i < kReceivers; ++i) {
      float sum = 0.0f;
      for (size_t pose = 0; pose < kMaxKeyPoses; ++pose) {
        const float weight = weights[i * kMaxKeyPoses + pose];
        EXPECT_GE(weight, 0.0f);
        sum += weight;
        if (pose >= static_cast<size_t>(poses)) {
          EXPECT_EQ(weight, 0.0f);
        }
      }
      EXPECT_NEAR(sum, 1.0f, 1e-6);
    }
  }
}

TEST(KeyPoses, AtAKeyPoseOnlyItCountsAndNothingIsLeftOver) {
  Random random(82);
  const std::vector<ShRows> keys = RandomKeys(random, 5);
  for (size_t pose = 0; pose < 5; ++pose) {
    const std::vector<float> weights = Weights(keys, keys[pose]);
    ShRows delta(kCount, kReceivers);
    SubtractKeyPoses(keys, keys[pose], weights, {0, kReceivers}, delta);
    for (size_t i = 0; i < kReceivers; ++i) {
      EXPECT_EQ(weights[i * kMaxKeyPoses + pose], 1.0f);
      for (int k = 0; k < kCount; ++k) {
        EXPECT_EQ(delta.at(k, i), 0.0f);
      }
    }
  }
}

TEST(KeyPoses, DeltaAndBlendTogetherAreWhatIs) {
  Random random(83);
  const std::vector<ShRows> keys = RandomKeys(random, 4);
  const ShRows now = Between(keys[1], keys[3], 0.4f);
  const std::vector<float> weights = Weights(keys, now);
  ShRows delta(kCount, kReceivers);
  SubtractKeyPoses(keys, now, weights, {0, kReceivers}, delta);
  for (size_t i = 0; i < kReceivers; ++i) {
    for (int k = 0; k < kCount; ++k) {
      double sum = delta.at(k, i);
      for (size_t pose = 0; pose < keys.size(); ++pose) {
        sum += weights[i * kMaxKeyPoses + pose] * keys[pose].at(k, i);
      }
      EXPECT_NEAR(sum, now.at(k, i), 1e-6);
    }
  }
}

TEST(KeyPoses, WeightsMoveFromPoseToPoseWithoutLeaps) {
  Random random(84);
  const std::vector<ShRows> keys = RandomKeys(random, 5);
  std::vector<float> before = Weights(keys, keys[0]);
  constexpr int kSteps = 2000;
  for (int step = 1; step <= kSteps; ++step) {
    const std::vector<float> weights =
        Weights(keys, Between(keys[0], keys[1], static_cast<float>(step) / kSteps));
    for (size_t i = 0; i < weights.size(); ++i) {
      EXPECT_LT(std::abs(weights[i] - before[i]), 0.02f) << "step " << step;
    }
    before = weights;
  }
  EXPECT_EQ(before[1], 1.0f);
}

TEST(KeyPoses, ThePriorDecidesWhereThePoseChangesNothing) {
  Random random(85);
  const std::vector<ShRows> keys(3, RandomLogs(random));
  const float prior[] = {0.0f, 0.75f, 0.25f};
  const std::vector<float> weights = Weights(keys, keys[0], prior);
  EXPECT_EQ(weights[0], 0.0f);
  EXPECT_NEAR(weights[1], 0.75f, 0.01f);
  EXPECT_NEAR(weights[2], 0.25f, 0.01f);
}

TEST(KeyPoses, FarFromAllThereAreStillWeights) {
  Random random(86);
  const std::vector<ShRows> keys = RandomKeys(random, 2);
  ShRows now(kCount, kReceivers);
  for (size_t i = 0; i < kReceivers; ++i) {
    now.at(0, i) = 1e6f;
  }
  const std::vector<float> weights = Weights(keys, now);
  EXPECT_NEAR(weights[0] + weights[1], 1.0f, 1e-5);
  EXPECT_GE(weights[0], 0.0f);
}

}  // namespace
}  // namespace lararium::light
