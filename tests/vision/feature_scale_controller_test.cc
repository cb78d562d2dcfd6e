#include "shared/vision/feature_scale_controller.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

namespace lararium::vision {
namespace {

// Number of features in a scene of the given richness: it falls with the threshold, and to a
// quarter with each later octave.
size_t FeaturesOf(double richness, const FeatureOptions& options) {
  const double octave = std::pow(0.25, options.first_octave + 1);
  return static_cast<size_t>(richness * octave * std::pow(options.contrast_threshold / 0.04, -0.8));
}

bool SameOptions(const FeatureOptions& a, const FeatureOptions& b) {
  return a.first_octave == b.first_octave && a.contrast_threshold == b.contrast_threshold;
}

// The quality of a pose from the share of the features that the map knows, each accurate to a
// pixel.
PoseQuality PoseOf(double share, size_t features) {
  const double inliers = share * static_cast<double>(features);
  return {static_cast<int>(inliers), 1.0 / std::sqrt(inliers + 1e-9)};
}

FeatureScaleController SettledAt(double richness, double share) {
  FeatureScaleController detail(1000);
  for (int frame = 0; frame < 40; ++frame) {
    const size_t features = FeaturesOf(richness, detail.options());
    detail.Observe(features, PoseOf(share, features));
  }
  return detail;
}

TEST(FeatureScaleController, SettlesNearTheBudget) {
  for (const double richness : {800.0, 2000.0, 6000.0, 20000.0, 60000.0}) {
    FeatureScaleController detail(1000);
    for (int frame = 0; frame < 40; ++frame) {
      detail.Observe(FeaturesOf(richness, detail.options()), std::nullopt);
    }
    const size_t features = FeaturesOf(richness, detail.options());
    EXPECT_GE(features, 700u) << "richness " << richness;
    EXPECT_LE(features, 5000u) << "richness " << richness;
  }
}

TEST(FeatureScaleController, DoesNotSwing) {
  for (double richness = 300.0; richness < 100000.0; richness *= 1.1) {
    FeatureScaleController detail(1000);
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

TEST(FeatureScaleController, LooksFinerWhereThePoseIsPoorThoughFeaturesAreMany) {
  for (const double richness : {2000.0, 6000.0, 20000.0}) {
    const double share = 0.02;  // 20 inliers from a thousand features.
    const FeatureScaleController detail = SettledAt(richness, share);
    const size_t features = FeaturesOf(richness, detail.options());
    EXPECT_GT(features, 1400u) << "richness " << richness;
    EXPECT_TRUE(detail.finest() || PoseOf(share, features).inliers >= 40)
        << "richness " << richness;
  }
}

TEST(FeatureScaleController, LooksFinerWhereTheErrorIsLargeThoughInliersAreMany) {
  FeatureScaleController detail(1000);
  for (int frame = 0; frame < 40; ++frame) {
    detail.Observe(1000, PoseQuality{.inliers = 200, .expected_error_px = 1.5});
  }
  EXPECT_TRUE(detail.finest());
}

TEST(FeatureScaleController, LooksCoarserWhereInliersAreFarBeyondNeed) {
  for (const double richness : {2000.0, 6000.0, 20000.0}) {
    const size_t features = FeaturesOf(richness, SettledAt(richness, 0.8).options());
    EXPECT_LT(features, FeaturesOf(richness, SettledAt(richness, 0.2).options()))
        << "richness " << richness;
    EXPECT_GT(PoseOf(0.8, features).inliers, 300) << "richness " << richness;
  }
}

TEST(FeatureScaleController, DoesNotSwingWhateverThePoses) {
  for (double richness = 300.0; richness < 100000.0; richness *= 1.1) {
    for (double share = 0.01; share < 1.0; share *= 1.15) {
      FeatureScaleController detail = SettledAt(richness, share);
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

TEST(FeatureScaleController, LooksAsFinelyAsItCanAtABlankWall) {
  FeatureScaleController detail(1000);
  for (int frame = 0; frame < 40; ++frame) {
    detail.Observe(3, std::nullopt);
  }
  EXPECT_TRUE(detail.finest());
  EXPECT_TRUE(SameOptions(detail.options(), detail.finest_options()));
  EXPECT_EQ(detail.options().first_octave, -1);
}

TEST(FeatureScaleController, AlwaysGivesValidOptions) {
  FeatureScaleController detail(1000);
  for (const size_t features : {0, 1000000}) {
    for (int frame = 0; frame < 40; ++frame) {
      EXPECT_TRUE(detail.options().Validate().ok());
      detail.Observe(features, std::nullopt);
    }
  }
}

}  // namespace
}  // namespace lararium::vision
