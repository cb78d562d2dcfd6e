#include "editor/train/guided_matching.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "editor/train/two_view.h"
#include "shared/core/random.h"

namespace lararium::train {
namespace {

constexpr double kGuidedFocal = 500.0;

vision::Descriptor RandomDescriptor(Random& random) {
  vision::Descriptor descriptor;
  double squared = 0.0;
  std::array<double, vision::kDescriptorSize> values;
  for (double& value : values) {
    value = std::abs(random.Normal());
    squared += value * value;
  }
  for (int i = 0; i < vision::kDescriptorSize; ++i) {
    descriptor[i] = static_cast<uint8_t>(std::min(255.0, 512.0 * values[i] / std::sqrt(squared)));
  }
  return descriptor;
}

// Two views of the same points; feature i of both views shows point i.
struct TwoViews {
  vision::Features a;
  vision::Features b;
  std::vector<Eigen::Vector2d> plane_a;
  std::vector<Eigen::Vector2d> plane_b;
  geometry::Rigid3 b_from_a;
};

TwoViews MakeViews(int count) {
  Random random(7);
  TwoViews views;
  views.b_from_a.rotation = Eigen::AngleAxisd(0.1, Eigen::Vector3d(0.3, 0.9, 0.1).normalized());
  views.b_from_a.translation = Eigen::Vector3d(0.9, 0.1, 0.2).normalized();
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d point{random.Uniform(-2, 2), random.Uniform(-2, 2), random.Uniform(3, 6)};
    views.plane_a.push_back(point.hnormalized());
    views.plane_b.push_back((views.b_from_a * point).hnormalized());
    vision::Keypoint keypoint;
    keypoint.scale = static_cast<float>(random.Uniform(1.5, 4.0));
    keypoint.angle = static_cast<float>(random.Uniform(-3.0, 3.0));
    views.a.keypoints.push_back(keypoint);
    keypoint.scale *= 1.2f;
    keypoint.angle += 0.5f;  // May leave -pi..pi.
    views.b.keypoints.push_back(keypoint);
    views.a.descriptors.push_back(RandomDescriptor(random));
    views.b.descriptors.push_back(views.a.descriptors.back());
    for (uint8_t& value : views.b.descriptors.back()) {
      value = static_cast<uint8_t>(std::clamp(value + 4.0 * random.Normal(), 0.0, 255.0));
    }
  }
  return views;
}

GuidedOptions OptionsFor(const TwoViews& views) {
  GuidedOptions options;
  options.fundamental = EssentialMatrix(views.b_from_a);
  options.band = 3.0 / kGuidedFocal;
  options.turn = 0.5f;
  options.growth = std::log2(1.2f);
  return options;
}

TEST(GuidedMatching, FindsEveryFeatureOnItsEpipolarLine) {
  const TwoViews views = MakeViews(500);
  const auto matches = MatchGuided(FeatureGrid(views.a, views.plane_a),
                                   FeatureGrid(views.b, views.plane_b), OptionsFor(views));
  ASSERT_EQ(matches.size(), 500u);
  for (uint32_t i = 0; i < 500; ++i) {
    EXPECT_EQ(matches[i].a, i);
    EXPECT_EQ(matches[i].b, i);
  }
}

TEST(GuidedMatching, LeavesOutWhatLiesOffTheLine) {
  TwoViews views = MakeViews(500);
  const Eigen::Matrix3d essential = EssentialMatrix(views.b_from_a);
  for (int i = 0; i < 500; i += 2) {  // Moved by 20 pixels across the line.
    const Eigen::Vector3d line = essential * views.plane_a[i].homogeneous();
    views.plane_b[i] += line.head<2>().normalized() * (20.0 / kGuidedFocal);
  }
  const auto matches = MatchGuided(FeatureGrid(views.a, views.plane_a),
                                   FeatureGrid(views.b, views.plane_b), OptionsFor(views));
  EXPECT_EQ(matches.size(), 250u);
  for (const FeatureMatch& match : matches) {
    EXPECT_EQ(match.a % 2, 1u);
  }
}

TEST(GuidedMatching, LeavesOutWhatIsTurnedOrScaledOtherwise) {
  TwoViews views = MakeViews(300);
  for (int i = 0; i < 100; ++i) {
    views.b.keypoints[i].angle += 2.0f;
    views.b.keypoints[i + 100].scale *= 3.0f;
  }
  const auto matches = MatchGuided(FeatureGrid(views.a, views.plane_a),
                                   FeatureGrid(views.b, views.plane_b), OptionsFor(views));
  ASSERT_EQ(matches.size(), 100u);
  EXPECT_EQ(matches.front().a, 200u);
}

TEST(GuidedMatching, LeavesOutWhatLooksAlikeTwice) {
  TwoViews views = MakeViews(300);
  // A copy of feature 0 within the band.
  views.b.keypoints.push_back(views.b.keypoints[0]);
  views.b.descriptors.push_back(views.b.descriptors[0]);
  views.plane_b.push_back(views.plane_b[0] + Eigen::Vector2d(1e-4, 1e-4));
  const auto matches = MatchGuided(FeatureGrid(views.a, views.plane_a),
                                   FeatureGrid(views.b, views.plane_b), OptionsFor(views));
  EXPECT_EQ(matches.size(), 299u);
  EXPECT_EQ(matches.front().a, 1u);
}

TEST(GuidedMatching, MeasuresHowTheImagesAreTurnedAndScaled) {
  const TwoViews views = MakeViews(100);
  std::vector<FeatureMatch> matches;
  for (uint32_t i = 0; i < 100; ++i) {
    matches.push_back({i, i});
  }
  GuidedOptions options;
  MeasureTurnAndGrowth(views.a, views.b, matches, options);
  EXPECT_NEAR(options.turn, 0.5f, 1e-4f);
  EXPECT_NEAR(options.growth, std::log2(1.2f), 1e-4f);
}

TEST(GuidedMatching, HasNothingToMatchInEmptyImages) {
  const TwoViews views = MakeViews(10);
  const FeatureGrid none(vision::Features(), {});
  const FeatureGrid some(views.a, views.plane_a);
  EXPECT_TRUE(MatchGuided(none, some, OptionsFor(views)).empty());
  EXPECT_TRUE(MatchGuided(some, none, OptionsFor(views)).empty());
}

}  // namespace
}  // namespace lararium::train
