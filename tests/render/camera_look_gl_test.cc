// Tests the softness, motion blur and noise of people with known input.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "shared/core/srgb.h"
#include "shared/core/units.h"
#include "shared/geometry/glm_convert.h"
#include "shared/render/clip_space.h"
#include "shared/render/renderer.h"
#include "tests/render/gl_fixture.h"
#include "tests/render/test_people.h"

namespace lararium::render {
namespace {
constexpr int kSize = 240;

// A grey disc (a ball under even light) of 60 pixels' radius on black.
class CameraLookTest : public GlTest {
 protected:
  void SetUp() override {
    GlTest::SetUp();
    auto renderer = Renderer::Create({.samples = 4});
    ASSERT_TRUE(renderer.ok()) << renderer.message();
    renderer_ = std::move(renderer).value();
    human_ = {.human = renderer_->AddHuman(Shared(MakeHuman(Sphere(glm::vec3(0.6f)), 1))).value(),
              .skin = {&skin_, 1}};
    human_.stage_from_actor[3] = glm::vec4(0.0f, 0.0f, -20.0f, 1.0f);
    scene_.humans = {&human_, 1};
    scene_.display = {.width = kSize,
                      .height = kSize,
                      .fx = 1200.0,
                      .fy = 1200.0,
                      .cx = 0.5 * (kSize - 1),
                      .cy = 0.5 * (kSize - 1)};
    scene_.camera_from_stage =
        LookAt(Eigen::Vector3d::Zero(), -Eigen::Vector3d::UnitZ(), Eigen::Vector3d::UnitY());
    scene_.light[0] = glm::vec3(1.0f / 0.28209479f);
    scene_.matte = true;
    scene_.knee = 1.0f;
  }
  cv::Mat Draw() {
    const RenderTarget target = MakeTarget(kSize, kSize);
    const Status drawn = renderer_->Draw(scene_, target);
    EXPECT_TRUE(drawn.ok()) << drawn.message();
    return Read(target);
  }
  static double Linear(uchar value) { return LinearFromSrgb(value / 255.0); }
  // The variance of the edge's slope along a row or column through the middle. It equals the
  // variance of the blur.
  static double EdgeVariance(const cv::Mat& picture, bool along_row) {
    double sum = 0.0, first = 0.0, second = 0.0;
    for (int i = kSize / 2; i + 1 < kSize; ++i) {
      const auto at = [&](int k) {
        return Linear(along_row ? picture.at<cv::Vec3b>(kSize / 2, k)[1]
                                : picture.at<cv::Vec3b>(k, kSize / 2)[1]);
      };
      const double slope = at(i) - at(i + 1);
      sum += slope;
      first += slope * i;
      second += slope * i * i;
    }
    const double mean = first / sum;
    return second / sum - mean * mean;
  }

  const glm::mat4 skin_ = glm::mat4(1.0f);
  std::unique_ptr<Renderer> renderer_;
  SceneHuman human_;
  light::CameraResponse response_;
  RenderScene scene_;
};

TEST_F(CameraLookTest, LensSoftensEdgesByItsVariance) {
  const cv::Mat sharp = Draw();
  const double before = EdgeVariance(sharp, true);
  EXPECT_LT(before, 0.4);
  for (const float blur : {0.8f, 1.5f}) {
    scene_.look.blur_px = blur;
    const cv::Mat soft = Draw();
    // Taps reach only 2.2 standard deviations, and bilinear sampling adds at most a quarter of a
    // squared pixel.
    EXPECT_NEAR(EdgeVariance(soft, true) - before, blur * blur, 0.2 * blur * blur + 0.25) << blur;
    EXPECT_NEAR(EdgeVariance(soft, false) - before, blur * blur, 0.2 * blur * blur + 0.25) << blur;
    EXPECT_EQ(soft.at<cv::Vec3b>(kSize / 2, kSize / 2), sharp.at<cv::Vec3b>(kSize / 2, kSize / 2));
  }
}

TEST_F(CameraLookTest, OwnMotionSmearsAlongItAlone) {
  const double before_row = EdgeVariance(Draw(), true);
  // Since the last frame, the camera has turned about its vertical axis by this number of pixels.
  const double pixels = 12.0;
  geometry::Rigid3 turned = *scene_.camera_from_stage;
  turned = geometry::Rigid3{geometry::RotationFromVector({0.0, pixels / 1200.0, 0.0}),
                            Eigen::Vector3d::Zero()} *
           turned;
  scene_.look.previous_camera_from_stage = turned;
  EXPECT_NEAR(EdgeVariance(Draw(), true), before_row, 1e-9) << "a closed shutter";
  for (const float shutter : {0.5f, 1.0f}) {
    scene_.look.shutter = shutter;
    const cv::Mat smeared = Draw();
    const double box = std::pow(shutter * pixels, 2) / 12.0;
    EXPECT_NEAR(EdgeVariance(smeared, true) - before_row, box, 0.2 * box + 0.25) << shutter;
    EXPECT_LT(EdgeVariance(smeared, false) - before_row, 0.4) << shutter;
  }
}

// The blur of a sideways motion depends on the distance of people. Here it has as many pixels as
// that of the turn above.
TEST_F(CameraLookTest, MotionSidewaysSmearsByTheDistanceOfPeople) {
  const double before = EdgeVariance(Draw(), true);
  const double pixels = 12.0;
  geometry::Rigid3 moved = *scene_.camera_from_stage;
  moved.translation += Eigen::Vector3d(pixels * 20.0 / 1200.0, 0.0, 0.0);
  scene_.look.previous_camera_from_stage = moved;
  scene_.look.shutter = 1.0f;
  EXPECT_NEAR(EdgeVariance(Draw(), true) - before, pixels * pixels / 12.0, 2.7);
}

// The middle of what a row shows, pixels.
double MiddleOfRow(const cv::Mat& picture, int row) {
  double sum = 0.0;
  double weighted = 0.0;
  for (int x = 0; x < picture.cols; ++x) {
    sum += picture.at<cv::Vec3b>(row, x)[1];
    weighted += x * picture.at<cv::Vec3b>(row, x)[1];
  }
  return weighted / sum;
}

TEST_F(CameraLookTest, ARollingShutterSeesEachRowAtItsOwnTime) {
  // Since a frame ago, the camera has turned so that all moved to the left by this many pixels.
  const double pixels = 12.0;
  scene_.camera = scene_.display;
  SceneShutter& shutter = scene_.shutter.emplace();
  shutter.previous_camera_from_stage =
      geometry::Rigid3{geometry::RotationFromVector({0.0, pixels / 1200.0, 0.0}),
                       Eigen::Vector3d::Zero()} *
      *scene_.camera_from_stage;
  const cv::Mat whole = Draw();
  for (const double readout : {0.8, -0.8}) {  // Downwards, upwards.
    shutter.readout = {0.0, readout};
    const cv::Mat rolled = Draw();
    for (const int offset : {-45, 0, 45}) {
      const int row = kSize / 2 + offset;
      const double time = readout * (row - 0.5 * (kSize - 1)) / kSize;
      EXPECT_NEAR(MiddleOfRow(rolled, row) - MiddleOfRow(whole, row), -time * pixels, 0.15)
          << readout << " " << offset;
    }
  }
}

TEST_F(CameraLookTest, NoiseHasTheGivenVarianceAndIsRepeatable) {
  const cv::Mat clean = Draw();
  scene_.look.noise_floor = 0.02f;
  scene_.look.noise_slope = 0.0008f;
  scene_.look.frame = 7;
  const cv::Mat noisy = Draw();
  const cv::Rect inside(90, 90, 60, 60);
  cv::Mat difference;
  cv::subtract(noisy(inside), clean(inside), difference, cv::noArray(), CV_64F);
  cv::Scalar mean, deviation;
  cv::meanStdDev(difference / 255.0, mean, deviation);
  const double value = clean.at<cv::Vec3b>(kSize / 2, kSize / 2)[0] / 255.0;
  for (int channel = 0; channel < 3; ++channel) {
    EXPECT_NEAR(mean[channel], 0.0, 0.002);
    EXPECT_NEAR(deviation[channel], std::sqrt(0.02 * 0.02 + 0.0008 * value), 0.0015);
  }
  EXPECT_EQ(noisy.at<cv::Vec3b>(5, 5), clean.at<cv::Vec3b>(5, 5)) << "nobody is there";
  EXPECT_EQ(cv::norm(noisy, Draw(), cv::NORM_INF), 0.0);
  scene_.look.frame = 8;
  EXPECT_GT(cv::norm(noisy, Draw(), cv::NORM_INF), 5.0);
}

TEST_F(CameraLookTest, PeopleAreSeenThroughTheMeasuredResponse) {
  response_ = light::SrgbResponse();
  for (size_t byte = 0; byte < 256; ++byte) {
    // Red follows the sRGB standard, green has the contrast of a film, blue has a black level.
    const double x = static_cast<double>(byte) / 255.0;
    response_.linear[1][byte] = static_cast<float>(1.5 * std::pow(x, 3.0));
    response_.linear[2][byte] = static_cast<float>(std::max(0.0, Linear(uchar(byte)) - 0.05));
  }
  scene_.response = &response_;
  for (const float exposure : {0.02f, 0.2f, 0.7f, 1.3f, 3.0f}) {
    scene_.exposure = exposure;
    scene_.response = nullptr;
    scene_.knee = 65504.0f;
    cv::Mat linear;
    ASSERT_TRUE(renderer_->DrawLinear(scene_, linear).ok());
    const auto middle = linear.at<cv::Vec4f>(linear.rows / 2, linear.cols / 2);
    scene_.response = &response_;
    const cv::Vec3b seen = Draw().at<cv::Vec3b>(kSize / 2, kSize / 2);
    for (int channel = 0; channel < 3; ++channel) {
      const float light = exposure * middle[channel];
      const light::CameraResponse::Curve& curve = response_.linear[static_cast<size_t>(channel)];
      const auto above = std::upper_bound(curve.begin(), curve.end(), light);
      const double expected =
          std::min<double>(255.0, static_cast<double>(above - curve.begin()) - 0.5);
      EXPECT_NEAR(seen[2 - channel], expected, 1.6) << exposure << ", channel " << channel;
    }
  }
}

TEST_F(CameraLookTest, AShoulderThatWasMeasuredIsDrawnAsTheKneeIs) {
  response_ = light::ShoulderResponse(0.5f);
  scene_.knee = 0.5f;
  for (const float exposure : {0.1f, 0.9f, 2.0f}) {
    scene_.exposure = exposure;
    scene_.response = nullptr;
    const cv::Mat by_knee = Draw();
    scene_.response = &response_;
    EXPECT_LE(cv::norm(by_knee, Draw(), cv::NORM_INF), 1.0) << exposure;
  }
}

}  // namespace
}  // namespace lararium::render
