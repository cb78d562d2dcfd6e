#include "shared/vision/level_of_detail.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lararium::vision {
namespace {

// Features of a scene of the given richness: fewer with a higher threshold, and
// a quarter with each later octave.
size_t FeaturesOf(double richness, const FeatureOptions& options) {
  const double octave = std::pow(0.25, options.first_octave + 1);
  return static_cast<size_t>(richness * octave * std::pow(options.contrast_threshold / 0.04, -0.8));
}

bool SameOptions(const FeatureOptions& a, const FeatureOptions& b) {
  return a.first_octave == b.first_octave && a.contrast_threshold == b.contrast_threshold;
}

TEST(LevelOfDetail, SettlesNearTheBudget) {
  for (const double richness : {800.0, 2000.0, 6000.0, 20000.0, 60000.0}) {
    LevelOfDetail detail(1000);
    for (int frame = 0; frame < 40; ++frame) {
      detail.Observe(FeaturesOf(richness, detail.options()));
    }
    const size_t features = FeaturesOf(richness, detail.options());
    EXPECT_GE(features, 700u) << "richness " << richness;
    EXPECT_LE(features, 5000u) << "richness " << richness;
  }
}

TEST(LevelOfDetail, DoesNotSwing) {
  for (double richness = 300.0; richness < 100000.0; richness *= 1.1) {
    LevelOfDetail detail(1000);
    for (int frame = 0; frame < 40; ++frame) {
      detail.Observe(FeaturesOf(richness, detail.options()));
    }
    const FeatureOptions settled = detail.options();
    for (int frame = 0; frame < 10; ++frame) {
      detail.Observe(FeaturesOf(richness, detail.options()));
      ASSERT_TRUE(SameOptions(detail.options(), settled)) << "richness " << richness;
    }
  }
}

TEST(LevelOfDetail, LooksAsFinelyAsItCanAtABlankWall) {
  LevelOfDetail detail(1000);
  for (int frame = 0; frame < 40; ++frame) {
    detail.Observe(3);
  }
  EXPECT_TRUE(detail.finest());
  EXPECT_TRUE(SameOptions(detail.options(), detail.finest_options()));
  EXPECT_EQ(detail.options().first_octave, -1);
}

TEST(LevelOfDetail, AlwaysGivesValidOptions) {
  LevelOfDetail detail(1000);
  for (const size_t features : {0, 1000000}) {
    for (int frame = 0; frame < 40; ++frame) {
      EXPECT_TRUE(detail.options().Validate().ok());
      detail.Observe(features);
    }
  }
}

}  // namespace
}  // namespace lararium::vision
