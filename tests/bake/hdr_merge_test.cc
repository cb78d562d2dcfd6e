#include "editor/bake/hdr_merge.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "tests/support/test_files.h"

namespace lararium::bake {
namespace {

using ::testing::HasSubstr;

// The byte that a camera with this response gives.
uchar Byte(const light::CameraResponse& response, int channel, double exposure) {
  const light::CameraResponse::Curve& curve = response.linear[channel];
  const auto above = std::lower_bound(curve.begin(), curve.end(), static_cast<float>(exposure));
  if (above == curve.begin()) {
    return 0;
  }
  if (above == curve.end()) {
    return 255;
  }
  const double share = (exposure - above[-1]) / (above[0] - above[-1]);
  return cv::saturate_cast<uchar>(static_cast<double>(above - curve.begin()) - 1.0 + share);
}

// Smooth patches from 0.003 to 60, slightly different in each channel. R, G, B.
cv::Mat Radiance() {
  cv::Mat radiance(120, 160, CV_32FC3);
  for (int y = 0; y < radiance.rows; ++y) {
    for (int x = 0; x < radiance.cols; ++x) {
      const double stops = -8.3 + 14.2 * (x / 160.0) + 0.6 * std::sin(0.08 * y);
      for (int c = 0; c < 3; ++c) {
        radiance.at<cv::Vec3f>(y, x)[c] =
            static_cast<float>(std::exp2(stops + 0.4 * c * std::sin(0.05 * (x + y))));
      }
    }
  }
  return radiance;
}

std::vector<Bracket> Photograph(const cv::Mat& radiance,
                                const light::CameraResponse& response,
                                double noise) {
  std::vector<Bracket> brackets;
  cv::RNG rng(7);
  for (const double exposure : {1.0 / 64, 1.0 / 16, 0.25, 1.0, 4.0, 16.0}) {
    cv::Mat bgr(radiance.size(), CV_8UC3);
    for (int y = 0; y < bgr.rows; ++y) {
      for (int x = 0; x < bgr.cols; ++x) {
        for (int c = 0; c < 3; ++c) {
          const double byte =
              Byte(response, c, exposure * radiance.at<cv::Vec3f>(y, x)[c]) + rng.gaussian(noise);
          bgr.at<cv::Vec3b>(y, x)[2 - c] = cv::saturate_cast<uchar>(byte);
        }
      }
    }
    brackets.push_back({"exposure " + std::to_string(exposure), bgr, exposure});
  }
  return brackets;
}

// Not a power: sRGB with highlights compressed from 0.6 on, as on film and telephones.
const light::CameraResponse kCamera = light::ShoulderResponse(0.6f);

TEST(CalibrateResponse, RecoversAKnownResponseWithinFivePercent) {
  const auto calibrated = CalibrateResponse(Photograph(Radiance(), kCamera, 1.0));
  ASSERT_TRUE(calibrated.ok()) << calibrated.message();
  for (int c = 0; c < 3; ++c) {
    double squares = 0.0;
    for (int i = 24; i <= 245; ++i) {
      const double off = std::log(calibrated->response.linear[c][i] / kCamera.linear[c][i]);
      EXPECT_LT(std::abs(off), 0.10) << "channel " << c << ", byte " << i;
      squares += off * off;
    }
    EXPECT_LT(std::sqrt(squares / 222.0), 0.05) << "channel " << c;
  }
  EXPECT_LT(calibrated->residual, 0.12);
  // The calibrated response shows the shoulder.
  const light::FittedKnee knee = light::FitKnee(calibrated->response);
  EXPECT_NEAR(knee.knee, 0.6f, 0.1f);
}

TEST(MergeBrackets, RecoversRadianceOverFourteenStops) {
  const cv::Mat radiance = Radiance();
  const auto brackets = Photograph(radiance, kCamera, 1.0);
  const auto calibrated = CalibrateResponse(brackets);
  ASSERT_TRUE(calibrated.ok()) << calibrated.message();
  for (const bool known : {true, false}) {
    const auto merged = MergeBrackets(brackets, known ? kCamera : calibrated->response);
    ASSERT_TRUE(merged.ok()) << merged.message();
    double squares = 0.0;
    double worst = 0.0;
    int count = 0;
    for (int y = 0; y < radiance.rows; ++y) {
      for (int x = 8; x < radiance.cols - 8; ++x) {
        for (int c = 0; c < 3; ++c) {
          const double off =
              std::log(merged->linear.at<cv::Vec3f>(y, x)[c] / radiance.at<cv::Vec3f>(y, x)[c]);
          squares += off * off;
          worst = std::max(worst, std::abs(off));
          ++count;
        }
      }
    }
    EXPECT_LT(std::sqrt(squares / count), known ? 0.04 : 0.06) << "known response: " << known;
    EXPECT_LT(worst, 0.5);
  }
}

TEST(MergeBrackets, WhatIsClippedEverywhereIsBrightNotOne) {
  cv::Mat radiance = Radiance();
  radiance(cv::Rect(40, 40, 8, 8)).setTo(cv::Scalar(1e4, 1e4, 1e4));
  radiance(cv::Rect(60, 40, 8, 8)).setTo(cv::Scalar(0, 0, 0));
  const auto merged = MergeBrackets(Photograph(radiance, kCamera, 0.0), kCamera);
  ASSERT_TRUE(merged.ok()) << merged.message();
  EXPECT_GE(merged->clipped, 64u);
  EXPECT_GE(merged->unexposed, 64u);
  EXPECT_GT(merged->linear.at<cv::Vec3f>(44, 44)[1], 60.0f);
  EXPECT_LT(merged->linear.at<cv::Vec3f>(44, 64)[1], 0.001f);
}

TEST(Brackets, SayWhatIsWrongWithThem) {
  const cv::Mat image(20, 20, CV_8UC3, cv::Scalar(9, 9, 9));
  const cv::Mat other(20, 30, CV_8UC3, cv::Scalar(9, 9, 9));
  const auto problem = [](std::vector<Bracket> brackets) { return Validate(brackets).message(); };
  EXPECT_THAT(problem({{"a", image, 1.0}}), HasSubstr("1 photographs"));
  EXPECT_THAT(problem({{"a", image, 1.0}, {"b", other, 2.0}}), HasSubstr("another size"));
  EXPECT_THAT(problem({{"a", image, 1.0}, {"b", image, 1.2}}), HasSubstr("nearly the same"));
  EXPECT_THAT(problem({{"a", image, 0.0}, {"b", image, 1.2}}), HasSubstr("not known"));
  EXPECT_THAT(problem({{"a", cv::Mat(), 1.0}, {"b", image, 2.0}}), HasSubstr("colour"));
  EXPECT_FALSE(CalibrateResponse(std::vector<Bracket>{{"a", image, 1.0}, {"b", image, 4.0}}).ok());
}

TEST(Brackets, AreReadWithTheirExposures) {
  test::TemporaryFolder folder;
  const cv::Mat image(20, 20, CV_8UC3, cv::Scalar(9, 9, 9));
  ASSERT_TRUE(cv::imwrite((folder / "a.png").string(), image));
  ASSERT_TRUE(cv::imwrite((folder / "b.png").string(), image));
  const std::vector<std::filesystem::path> files = {folder / "a.png", folder / "b.png"};
  const auto read = ReadBrackets(files, std::vector<double>{0.25, 1.0});
  ASSERT_TRUE(read.ok()) << read.message();
  EXPECT_EQ((*read)[1].exposure, 1.0);
  EXPECT_THAT(ReadBrackets(files, {}).message(), HasSubstr("not known"));
  EXPECT_THAT(ReadBrackets(files, std::vector<double>{1.0}).message(), HasSubstr("1 exposures"));
  const std::vector<std::filesystem::path> absent = {folder / "a.png", folder / "c.png"};
  EXPECT_FALSE(ReadBrackets(absent, std::vector<double>{0.25, 1.0}).ok());
}

}  // namespace
}  // namespace lararium::bake
