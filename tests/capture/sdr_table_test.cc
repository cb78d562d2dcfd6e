#include "shared/capture/sdr_table.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <opencv2/core.hpp>

namespace lararium::capture {
namespace {

constexpr FilmColours kHlg = {Transfer::kHlg, Gamut::kBt2020};
constexpr FilmColours kPq = {Transfer::kPq, Gamut::kBt2020};

// HLG's and PQ's signal for grey of a luminance in cd/m2 (BT.2100, inverse of tables 4 and 5).
double HlgSignal(double luminance) {
  const double scene = std::pow(luminance / 1000.0, 1.0 / 1.2);
  return scene <= 1.0 / 12.0 ? std::sqrt(3.0 * scene)
                             : 0.17883277 * std::log(12.0 * scene - 0.28466892) + 0.55991073;
}
double PqSignal(double luminance) {
  const double power = std::pow(luminance / 10000.0, 0.1593017578125);
  return std::pow((0.8359375 + 18.8515625 * power) / (1.0 + 18.6875 * power), 78.84375);
}

cv::Mat Coded(double red, double green, double blue) {
  const auto code = [](double value) { return static_cast<uint16_t>(std::lround(65535 * value)); };
  return cv::Mat(40, 24, CV_16UC3, cv::Scalar(code(blue), code(green), code(red)));
}

cv::Vec3b Converted(const SdrTable& table, const cv::Mat& coded) {
  cv::Mat bgr;
  table.Apply(coded, bgr);
  EXPECT_EQ(bgr.type(), CV_8UC3);
  EXPECT_EQ(cv::norm(bgr, cv::Mat(bgr.size(), CV_8UC3, cv::Scalar(bgr.at<cv::Vec3b>(0, 0))),
                     cv::NORM_INF),
            0.0);
  return bgr.at<cv::Vec3b>(39, 23);
}

// The code of ordinary video that shows a share of white (ITU-R BT.1886).
double OrdinaryCode(double share) { return 255.0 * std::pow(share, 1.0 / 2.4); }

TEST(SdrTable, GreyOfAFilmWithoutHighlightsIsThatOfItsOrdinaryTwin) {
  for (const double white : {100.0, 203.0}) {
    const SdrTable hlg(kHlg, white);
    const SdrTable pq(kPq, white);
    for (const double share : {0.01, 0.05, 0.2, 0.5, 0.8, 1.0}) {
      const double h = HlgSignal(share * white);
      const double p = PqSignal(share * white);
      for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(Converted(hlg, Coded(h, h, h))[c], OrdinaryCode(share), 2.0) << share;
        EXPECT_NEAR(Converted(pq, Coded(p, p, p))[c], OrdinaryCode(share), 2.5) << share;
      }
    }
  }
}

TEST(SdrTable, CompressesHighlightsInsteadOfCuttingThem) {
  const SdrTable table(kHlg, 1000.0);
  int before = 0;
  for (const double luminance : {20.0, 60.0, 120.0, 203.0, 400.0, 700.0, 1000.0}) {
    const double signal = HlgSignal(luminance);
    const int code = Converted(table, Coded(signal, signal, signal))[1];
    EXPECT_GT(code, before) << luminance;
    if (luminance < 0.5 * 203.0) {
      EXPECT_NEAR(code, OrdinaryCode(luminance / 203.0), 2.0) << luminance;
    }
    before = code;
  }
  EXPECT_GE(before, 253);
}

TEST(SdrTable, TakesRedOfBt709FromBt2020) {
  // The share of each BT.2020 primary in red of BT.709 (ITU-R BT.2087).
  const auto coded = [](double linear) { return std::pow(linear, 1.0 / 2.4); };
  const SdrTable table({Transfer::kGamma, Gamut::kBt2020}, 0.0);
  const cv::Vec3b red =
      Converted(table, Coded(coded(0.5 * 0.6274), coded(0.5 * 0.0691), coded(0.5 * 0.0164)));
  EXPECT_NEAR(red[2], OrdinaryCode(0.5), 2.0);
  EXPECT_LT(red[0], 40);
  EXPECT_LT(red[1], 40);
}

TEST(SdrTable, GreyStaysGreyWhateverTheGamut) {
  for (const Gamut gamut : {Gamut::kBt709, Gamut::kBt2020, Gamut::kP3}) {
    const SdrTable table({Transfer::kGamma, gamut}, 0.0);
    for (const double value : {0.1, 0.4, 0.9}) {
      const cv::Vec3b grey = Converted(table, Coded(value, value, value));
      for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(grey[c], 255.0 * value, 1.5) << value;
      }
    }
  }
}

TEST(HighlightLuminance, IgnoresAFewBrightPixels) {
  const double dim = HlgSignal(50.0);
  cv::Mat coded(400, 400, CV_16UC3, cv::Scalar::all(65535 * dim));
  coded(cv::Rect(0, 0, 12, 12)).setTo(cv::Scalar::all(65535));
  EXPECT_NEAR(HighlightLuminance(kHlg, coded), 50.0, 0.5);
  coded(cv::Rect(0, 0, 100, 100)).setTo(cv::Scalar::all(65535));
  EXPECT_NEAR(HighlightLuminance(kHlg, coded), 1000.0, 1.0);
}

}  // namespace
}  // namespace lararium::capture
