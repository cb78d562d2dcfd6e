#include "editor/train/matching.h"

#include <gtest/gtest.h>

#include "shared/core/random.h"
#include "shared/vision/descriptor_forest.h"

namespace lararium::train {
namespace {

using vision::Descriptor;

std::vector<Descriptor> RandomDescriptors(size_t count, uint64_t seed) {
  Random random(seed);
  std::vector<Descriptor> descriptors(count);
  for (Descriptor& descriptor : descriptors) {
    for (uint8_t& value : descriptor) {
      value = static_cast<uint8_t>(random.Below(256));
    }
  }
  return descriptors;
}

TEST(MatchDescriptors, FindsNoisyCopiesInAnyOrder) {
  Random random(3);
  const std::vector<Descriptor> a = RandomDescriptors(101, 1);  // Not a multiple of any block size.
  std::vector<Descriptor> b = RandomDescriptors(30, 2);
  for (size_t i = 0; i < 70; ++i) {
    Descriptor copy = a[100 - i];
    copy[random.Below(128)] ^= 7;
    b.push_back(copy);
  }
  const std::vector<FeatureMatch> matches = MatchDescriptors(a, b, 0.8f);
  ASSERT_EQ(matches.size(), 70u);
  for (const FeatureMatch& match : matches) {
    EXPECT_EQ(match.b, 30 + 100 - match.a);
  }
}

TEST(MatchDescriptors, LeavesOutAmbiguousOnes) {
  const std::vector<Descriptor> a = RandomDescriptors(1, 4);
  const std::vector<Descriptor> twins = {a[0], a[0]};
  EXPECT_TRUE(MatchDescriptors(a, twins, 0.8f).empty());
  EXPECT_TRUE(MatchDescriptors(twins, a, 0.8f).empty());
}

TEST(MatchDescriptors, OfNothingIsNothing) {
  const std::vector<Descriptor> a = RandomDescriptors(5, 5);
  EXPECT_TRUE(MatchDescriptors(a, {}, 0.8f).empty());
  EXPECT_TRUE(MatchDescriptors({}, a, 0.8f).empty());
}

TEST(NearestCenters, AgreesWithTheDistances) {
  const std::vector<Descriptor> queries = RandomDescriptors(33, 6);
  const std::vector<Descriptor> centers = RandomDescriptors(70, 7);
  const std::vector<uint32_t> nearest = NearestCenters(queries, centers);
  for (size_t i = 0; i < queries.size(); ++i) {
    for (const Descriptor& center : centers) {
      EXPECT_LE(vision::SquaredDistance(queries[i], centers[nearest[i]]),
                vision::SquaredDistance(queries[i], center));
    }
  }
}

TEST(StrongestFeatures, AreThoseOfLargestResponse) {
  vision::Features features;
  for (const float response : {0.3f, 0.9f, 0.1f, 0.9f, 0.5f}) {
    features.keypoints.push_back({.response = response});
    features.descriptors.emplace_back();
  }
  EXPECT_EQ(StrongestFeatures(features, 3), (std::vector<uint32_t>{1, 3, 4}));
  EXPECT_EQ(StrongestFeatures(features, 9).size(), 5u);
}

}  // namespace
}  // namespace lararium::train
