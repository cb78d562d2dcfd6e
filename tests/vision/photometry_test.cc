#include "shared/vision/photometry.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace lararium::vision {
namespace {

cv::Mat Plain(uint8_t red, uint8_t green, uint8_t blue) {
  return cv::Mat(20, 30, CV_8UC3, cv::Scalar(blue, green, red));
}

TEST(Photometry, DecodesTheSrgbCurve) {
  EXPECT_EQ(LinearFromSrgb(0), 0.0f);
  EXPECT_EQ(LinearFromSrgb(255), 1.0f);
  // Below 0.04045 the curve is a line. The byte 188 is half the light.
  EXPECT_NEAR(LinearFromSrgb(5), 5.0 / 255.0 / 12.92, 1e-7);
  EXPECT_NEAR(LinearFromSrgb(188), 0.5, 0.005);
  for (int i = 1; i < 256; ++i) {
    EXPECT_GT(LinearFromSrgb(static_cast<uint8_t>(i)), LinearFromSrgb(static_cast<uint8_t>(i - 1)));
  }
}

TEST(Photometry, OrdersChannelsRedGreenBlue) {
  const auto colour = SampleLinear(Plain(150, 120, 60), 10.0f, 10.0f);
  ASSERT_TRUE(colour.has_value());
  EXPECT_NEAR(colour->rgb[0], LinearFromSrgb(150), 1e-5);
  EXPECT_NEAR(colour->rgb[1], LinearFromSrgb(120), 1e-5);
  EXPECT_NEAR(colour->rgb[2], LinearFromSrgb(60), 1e-5);
  EXPECT_TRUE((colour->weight.array() == 1.0f).all());
}

TEST(Photometry, AveragesLightNotCode) {
  cv::Mat image = Plain(0, 0, 0);
  image(cv::Rect(8, 8, 5, 5)).setTo(cv::Scalar(40, 40, 40));
  image.at<cv::Vec3b>(10, 10) = cv::Vec3b(200, 200, 200);
  const auto colour = SampleLinear(image, 10.4f, 9.6f);  // The nearest pixel is (10, 10).
  ASSERT_TRUE(colour.has_value());
  const float expected = (24.0f * LinearFromSrgb(40) + LinearFromSrgb(200)) / 25.0f;
  EXPECT_NEAR(colour->rgb[1], expected, 1e-6);
}

TEST(Photometry, TakesNoSampleAcrossTheBorder) {
  const cv::Mat image = Plain(100, 100, 100);
  EXPECT_TRUE(SampleLinear(image, 2.0f, 2.0f).has_value());
  EXPECT_TRUE(SampleLinear(image, 27.0f, 17.0f).has_value());
  EXPECT_FALSE(SampleLinear(image, 1.4f, 2.0f).has_value());
  EXPECT_FALSE(SampleLinear(image, 27.6f, 2.0f).has_value());
  EXPECT_FALSE(SampleLinear(image, 10.0f, 17.6f).has_value());
  EXPECT_FALSE(SampleLinear(image, std::numeric_limits<float>::quiet_NaN(), 2.0f).has_value());
  EXPECT_FALSE(SampleLinear(image, 1e30f, 2.0f).has_value());
}

TEST(Photometry, TrustsNeitherClippedNorDarkChannels) {
  const auto colour = SampleLinear(Plain(255, 128, 3), 10.0f, 10.0f);
  ASSERT_TRUE(colour.has_value());
  EXPECT_EQ(colour->weight[0], 0.0f);
  EXPECT_EQ(colour->weight[1], 1.0f);
  EXPECT_EQ(colour->weight[2], 0.0f);
  const float highlight = SampleLinear(Plain(190, 190, 190), 10.0f, 10.0f)->weight[0];
  EXPECT_GT(highlight, 0.0f);
  EXPECT_LT(highlight, 1.0f);
  cv::Mat glint = Plain(100, 100, 100);  // One clipped pixel spoils the mean.
  glint.at<cv::Vec3b>(11, 11) = cv::Vec3b(255, 255, 255);
  EXPECT_EQ(SampleLinear(glint, 10.0f, 10.0f)->weight[1], 0.0f);
}

}  // namespace
}  // namespace lararium::vision
