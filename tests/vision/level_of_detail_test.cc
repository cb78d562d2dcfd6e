#include "shared/vision/level_of_detail.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

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

// A pose from the share of the features that the map knows, each good to a pixel.
PoseQuality PoseOf(double share, size_t features) {
  const double inliers = share * static_cast<double>(features);
  return {static_cast<int>(inliers), 1.0 / std::sqrt(inliers + 1e-9)};
}

LevelOfDetail SettledAt(double richness, double share) {
  LevelOfDetail detail(1000);
  for (int frame = 0; frame < 40; ++frame) {
    const size_t features = FeaturesOf(richness, detail.options());
    detail.Observe(features, PoseOf(share, features));
  }
  return detail;
}

TEST(LevelOfDetail, SettlesNearTheBudget) {
  for (const double richness : {800.0, 2000.0, 6000.0, 20000.0, 60000.0}) {
    LevelOfDetail detail(1000);
    for (int frame = 0; frame < 40; ++frame) {
      detail.Observe(FeaturesOf(richness, detail.options()), std::nullopt);
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
      detail.Observe(FeaturesOf(richness, detail.options()), std::nullopt);
    }
    const FeatureOptions settled = detail.options();
    for (int frame = 0; frame < 10; ++frame) {
      detail.Observe(FeaturesOf(richness, detail.options()), std::nullopt);
      ASSERT_TRUE(SameOptions(detail.options(), settled)) << "richness " << richness;
    }
  }
}

TEST(LevelOfDetail, LooksFinerWhereThePoseIsPoorThoughFeaturesAreMany) {
  for (const double richness : {2000.0, 6000.0, 20000.0}) {
    const double share = 0.02;  // of a thousand features: 20 inliers
    const LevelOfDetail detail = SettledAt(richness, share);
    const size_t features = FeaturesOf(richness, detail.options());
    EXPECT_GT(features, 1400u) << "richness " << richness;
    EXPECT_TRUE(detail.finest() || PoseOf(share, features).inliers >= 40)
        << "richness " << richness;
  }
}

TEST(LevelOfDetail, LooksFinerWhereTheErrorIsLargeThoughInliersAreMany) {
  LevelOfDetail detail(1000);
  for (int frame = 0; frame < 40; ++frame) {
    detail.Observe(1000, PoseQuality{.inliers = 200, .expected_error_px = 1.5});
  }
  EXPECT_TRUE(detail.finest());
}

TEST(LevelOfDetail, LooksCoarserWhereInliersAreFarBeyondNeed) {
  for (const double richness : {2000.0, 6000.0, 20000.0}) {
    const size_t features = FeaturesOf(richness, SettledAt(richness, 0.8).options());
    EXPECT_LT(features, FeaturesOf(richness, SettledAt(richness, 0.2).options()))
        << "richness " << richness;
    EXPECT_GT(PoseOf(0.8, features).inliers, 300) << "richness " << richness;
  }
}

TEST(LevelOfDetail, DoesNotSwingWhateverThePoses) {
  for (double richness = 300.0; richness < 100000.0; richness *= 1.1) {
    for (double share = 0.01; share < 1.0; share *= 1.15) {
      LevelOfDetail detail = SettledAt(richness, share);
      const FeatureOptions settled = detail.options();
      for (int frame = 0; frame < 5; ++frame) {
        const size_t features = FeaturesOf(richness, detail.options());
        detail.Observe(features, PoseOf(share, features));
        ASSERT_TRUE(SameOptions(detail.options(), settled))
            << "richness " << richness << " share " << share;
      }
    }
  }
}

TEST(LevelOfDetail, LooksAsFinelyAsItCanAtABlankWall) {
  LevelOfDetail detail(1000);
  for (int frame = 0; frame < 40; ++frame) {
    detail.Observe(3, std::nullopt);
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
      detail.Observe(features, std::nullopt);
    }
  }
}

}  // namespace
}  // namespace lararium::vision
