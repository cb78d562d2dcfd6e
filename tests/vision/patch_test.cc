#include "shared/vision/patch.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>
#include <functional>

#include "shared/core/random.h"

namespace lararium::vision {
namespace {

constexpr int kSide = 160;

// A brightness function over the plane: a sum of waves with wavelengths of at least 5 pixels.
class Texture {
 public:
  explicit Texture(uint64_t seed) {
    Random random(seed);
    for (Wave& wave : waves_) {
      const double length = random.Uniform(5.0, 25.0);
      const double angle = random.Uniform(0.0, M_PI);
      wave = {2.0 * M_PI / length * std::cos(angle), 2.0 * M_PI / length * std::sin(angle),
              random.Uniform(0.0, 2.0 * M_PI)};
    }
  }
  double operator()(double x, double y) const {
    double sum = 128.0;
    for (const Wave& wave : waves_) {
      sum += 9.0 * std::sin(wave.x * x + wave.y * y + wave.phase);
    }
    return sum;
  }

 private:
  struct Wave {
    double x, y, phase;
  };
  std::array<Wave, 12> waves_;
};

cv::Mat Render(const std::function<double(double, double)>& brightness) {
  cv::Mat image(kSide, kSide, CV_8UC1);
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      image.at<uint8_t>(y, x) = cv::saturate_cast<uint8_t>(brightness(x, y));
    }
  }
  return image;
}

struct Errors {
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  double rms = 0.0;
  double correlation = 0.0;
  int found = 0;
};

// Errors of patches of source that are searched in image, whose content is shifted by shift.
Errors Measure(const cv::Mat& source,
               const cv::Mat& image,
               const Eigen::Vector2f& shift,
               const PatchMotion& motion) {
  Random random(4);
  Errors errors;
  for (int i = 0; i < 300; ++i) {
    PatchWarp warp;
    warp.centre = {static_cast<float>(random.Uniform(30.0, kSide - 30.0)),
                   static_cast<float>(random.Uniform(30.0, kSide - 30.0))};
    warp.motion = motion;
    PatchTemplate patch;
    PatchFit fit;
    const Eigen::Vector2f start = warp.centre + shift +
                                  Eigen::Vector2f{static_cast<float>(random.Uniform(-0.8, 0.8)),
                                                  static_cast<float>(random.Uniform(-0.8, 0.8))};
    if (!patch.Sample(source, warp) || !AlignPatch(image, patch, start, {}, fit)) {
      continue;
    }
    const Eigen::Vector2d error = (fit.centre - warp.centre - shift).cast<double>();
    errors.mean += error;
    errors.rms += error.squaredNorm();
    errors.correlation += fit.correlation;
    ++errors.found;
  }
  errors.mean /= errors.found;
  errors.rms = std::sqrt(errors.rms / errors.found);
  errors.correlation /= errors.found;
  return errors;
}

TEST(AlignPatch, FindsFractionsOfAPixelWithoutBias) {
  const Texture texture(1);
  const cv::Mat source = Render(texture);
  for (const Eigen::Vector2f& shift :
       {Eigen::Vector2f(0.25f, -0.4f), Eigen::Vector2f(-0.5f, 0.1f), Eigen::Vector2f(3.7f, 2.3f)}) {
    const cv::Mat image =
        Render([&](double x, double y) { return texture(x - shift.x(), y - shift.y()); });
    const Errors errors = Measure(source, image, shift, {});
    EXPECT_GT(errors.found, 280);
    EXPECT_LT(errors.mean.norm(), 0.01) << shift.transpose();
    EXPECT_LT(errors.rms, 0.06) << shift.transpose();
  }
}

TEST(AlignPatch, DoesNotMindGainAndOffset) {
  const Texture texture(2);
  const Eigen::Vector2f shift(0.6f, 0.3f);
  const cv::Mat image = Render(
      [&](double x, double y) { return 40.0 + 0.5 * texture(x - shift.x(), y - shift.y()); });
  const Errors errors = Measure(Render(texture), image, shift, {});
  EXPECT_GT(errors.found, 280);
  EXPECT_LT(errors.mean.norm(), 0.01);
  EXPECT_GT(errors.correlation, 0.98);
}

TEST(AlignPatch, FindsTheMiddleOfTheExposureInABlurredImage) {
  const Texture texture(3);
  const PatchMotion motion{{9.0f, -4.0f}, {3.0f, 5.0f}};
  const cv::Mat image = Render([&](double x, double y) {
    double sum = 0.0;
    constexpr int kSteps = 60;
    for (int i = 0; i < kSteps; ++i) {
      const double t = (i + 0.5) / kSteps - 0.5;
      sum += texture(x - motion.velocity.x() * t - 0.5 * motion.acceleration.x() * t * t,
                     y - motion.velocity.y() * t - 0.5 * motion.acceleration.y() * t * t);
    }
    return sum / kSteps;
  });
  const cv::Mat source = Render(texture);
  const Errors blurred = Measure(source, image, Eigen::Vector2f::Zero(), motion);
  const Errors sharp = Measure(source, image, Eigen::Vector2f::Zero(), {});
  EXPECT_GT(blurred.correlation, 0.98);
  EXPECT_LT(blurred.mean.norm(), 0.02);
  EXPECT_LT(blurred.rms, 0.3 * sharp.rms);
}

TEST(AlignPatch, ForetellsItsScatter) {
  const Texture texture(5);
  const cv::Mat source = Render(texture);
  constexpr double kNoise = 6.0;
  Random random(6);
  double normalised = 0.0;
  int count = 0;
  for (int image_index = 0; image_index < 12; ++image_index) {
    const cv::Mat image =
        Render([&](double x, double y) { return texture(x, y) + kNoise * random.Normal(); });
    for (int i = 0; i < 60; ++i) {
      // Centres are on whole pixels, because interpolation would smooth the noise.
      const Eigen::Vector2f centre{30.5f + static_cast<float>(random.Below(100)),
                                   30.5f + static_cast<float>(random.Below(100))};
      PatchTemplate patch;
      PatchFit fit;
      ASSERT_TRUE(patch.Sample(source, {.centre = centre}));
      if (AlignPatch(image, patch, centre, {}, fit)) {
        const Eigen::Vector2f error = fit.centre - centre;
        normalised += error.dot(fit.information * error);
        ++count;
      }
    }
  }
  ASSERT_GT(count, 600);
  const double mean = normalised / (2 * count);
  EXPECT_GT(mean, 0.5);
  EXPECT_LT(mean, 1.5);
}

TEST(AlignPatch, KnowsNothingAlongAnEdge) {
  const cv::Mat source =
      Render([](double x, double) { return 128.0 + 80.0 * std::tanh((x - 80.0) / 1.5); });
  PatchTemplate patch;
  ASSERT_TRUE(patch.Sample(source, {.centre = {80.0f, 80.0f}}));
  PatchFit fit;
  ASSERT_TRUE(AlignPatch(source, patch, {80.6f, 80.0f}, {}, fit));
  EXPECT_NEAR(fit.centre.x(), 80.0, 0.02);
  EXPECT_LT(fit.information(1, 1), 1e-3f * fit.information(0, 0));
}

TEST(PatchTemplate, RefusesFlatGroundAndTheBorder) {
  const cv::Mat flat(kSide, kSide, CV_8UC1, cv::Scalar(90));
  PatchTemplate patch;
  EXPECT_FALSE(patch.Sample(flat, {.centre = {80.0f, 80.0f}}));
  const cv::Mat source = Render(Texture(7));
  EXPECT_TRUE(patch.Sample(source, {.centre = {80.0f, 80.0f}}));
  EXPECT_FALSE(patch.Sample(source, {.centre = {3.0f, 80.0f}}));
  EXPECT_FALSE(patch.Sample(source, {.centre = {80.0f, kSide - 4.0f}}));
  PatchFit fit;
  ASSERT_TRUE(patch.Sample(source, {.centre = {80.0f, 80.0f}}));
  EXPECT_FALSE(AlignPatch(source, patch, {2.0f, 80.0f}, {}, fit));
  EXPECT_EQ(CorrelatePatch(source, patch, {-5.0f, 80.0f}), -1.0f);
  EXPECT_NEAR(CorrelatePatch(source, patch, {80.0f, 80.0f}), 1.0f, 1e-4f);
}

TEST(PatchTemplate, RefusesInvertedContrast) {
  const Texture texture(8);
  const cv::Mat image = Render([&](double x, double y) { return 255.0 - texture(x, y); });
  PatchTemplate patch;
  ASSERT_TRUE(patch.Sample(Render(texture), {.centre = {80.0f, 80.0f}}));
  PatchFit fit;
  EXPECT_FALSE(AlignPatch(image, patch, {80.0f, 80.0f}, {}, fit) && fit.correlation > 0.7f);
}

}  // namespace
}  // namespace lararium::vision
