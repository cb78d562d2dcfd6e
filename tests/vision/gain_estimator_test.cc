#include "shared/vision/gain_estimator.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "shared/core/random.h"
#include "shared/core/srgb.h"

namespace lararium::vision {
namespace {

uint8_t ByteFromLinear(double linear) {
  return static_cast<uint8_t>(std::lround(255.0 * SrgbFromLinear(std::clamp(linear, 0.0, 1.0))));
}

struct Scene {
  cv::Mat bgr = cv::Mat(400, 400, CV_8UC3);
  SceneDatabase database;
  std::vector<SeenPoint> seen;
};

// An image of 300 squares of known colours with a gain; a share of them is hidden.
Scene MakeScene(const std::array<double, 3>& gain, double hidden) {
  Random random(3);
  Scene scene;
  for (uint32_t i = 0; i < 300; ++i) {
    const int x = 10 + 20 * static_cast<int>(i % 18);
    const int y = 10 + 20 * static_cast<int>(i / 18);
    Eigen::Vector3f colour;
    cv::Vec3b shown;
    const bool covered = random.Uniform() < hidden;
    for (int c = 0; c < 3; ++c) {
      colour[c] = static_cast<float>(random.Uniform(0.05, 0.4));
      const double light = covered ? 0.5 : gain[static_cast<size_t>(c)] * colour[c];
      shown[2 - c] = ByteFromLinear(light);
    }
    scene.bgr(cv::Rect(x - 8, y - 8, 17, 17)) = cv::Scalar(shown[0], shown[1], shown[2]);
    scene.database.colours.push_back(colour);
    scene.seen.push_back({i, Eigen::Vector2f(x, y)});
  }
  return scene;
}

TEST(GainEstimator, FindsTheGainOfEachChannelBehindHands) {
  const std::array<double, 3> gain = {0.8, 1.2, 0.5};
  for (const double hidden : {0.0, 0.3}) {
    const Scene scene = MakeScene(gain, hidden);
    GainEstimator estimator;
    const auto estimate = estimator.Estimate(scene.bgr, scene.database, scene.seen);
    ASSERT_TRUE(estimate.has_value());
    for (size_t c = 0; c < 3; ++c) {
      EXPECT_NEAR((*estimate)[c] / gain[c], 1.0, 0.02) << hidden;
    }
  }
}

TEST(GainEstimator, SaysNothingWithoutColoursOrPoints) {
  Scene scene = MakeScene({1.0, 1.0, 1.0}, 0.0);
  GainEstimator estimator;
  EXPECT_FALSE(estimator.Estimate(scene.bgr, scene.database, {scene.seen.data(), 5}).has_value());
  EXPECT_FALSE(estimator.Estimate(cv::Mat(), scene.database, scene.seen).has_value());
  scene.database.colours.clear();
  EXPECT_FALSE(estimator.Estimate(scene.bgr, scene.database, scene.seen).has_value());
}

}  // namespace
}  // namespace lararium::vision
