#include "shared/show/gain_filter.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lararium::show {
namespace {

constexpr double kTau = GainFilter::kTimeConstant;
using Gain = std::array<float, 3>;

TEST(GainFilter, TakesTheFirstGainAsItIs) {
  GainFilter filter;
  const Gain gain = filter.Update({0.5f, 1.0f, 2.0f}, 7.0);
  EXPECT_FLOAT_EQ(gain[0], 0.5f);
  EXPECT_FLOAT_EQ(gain[1], 1.0f);
  EXPECT_FLOAT_EQ(gain[2], 2.0f);
}

TEST(GainFilter, StepsDecayExponentiallyAtAnyFrameRate) {
  for (const double rate : {10.0, 30.0, 60.0, 144.0}) {
    GainFilter filter;
    filter.Update({1.0f, 1.0f, 1.0f}, 0.0);
    for (int i = 1; i <= static_cast<int>(rate); ++i) {
      const double time = i / rate;
      const Gain gain = filter.Update({0.5f, 0.25f, 1.0f}, time);
      const double left = std::exp(-time / kTau);
      EXPECT_NEAR(std::log2(gain[0]), -1.0 * (1.0 - left), 1e-5) << rate << " per second";
      EXPECT_NEAR(std::log2(gain[1]), -2.0 * (1.0 - left), 1e-5) << rate << " per second";
      EXPECT_NEAR(gain[2], 1.0f, 1e-6f);
    }
  }
}

TEST(GainFilter, UnevenFramesGiveWhatEvenOnesGive) {
  GainFilter filter;
  filter.Update({1.0f, 1.0f, 1.0f}, 0.0);
  for (const double time : {0.01, 0.011, 0.09, 0.2}) {
    filter.Update({4.0f, 1.0f, 1.0f}, time);
  }
  const Gain gain = filter.Update({4.0f, 1.0f, 1.0f}, 0.3);
  EXPECT_NEAR(std::log2(gain[0]), 2.0 * (1.0 - std::exp(-0.3 / kTau)), 1e-5);
}

TEST(GainFilter, HalvesNoiseOfSingleFramesAndMore) {
  // Alternating +-e at 30 frames a second leaves e a / (2 - a), a the share of a frame.
  GainFilter filter;
  const double share = 1.0 - std::exp(-1.0 / 30.0 / kTau);
  double largest = 0.0;
  for (int i = 0; i < 300; ++i) {
    const float noisy = std::exp(i % 2 == 0 ? 0.1f : -0.1f);
    const Gain gain = filter.Update({noisy, noisy, noisy}, i / 30.0);
    if (i > 100) {
      largest = std::max(largest, std::abs(std::log(static_cast<double>(gain[0]))));
    }
  }
  EXPECT_NEAR(largest, 0.1 * share / (2.0 - share), 1e-4);
  EXPECT_LT(largest, 0.02);
}

TEST(GainFilter, TheSameFrameAgainChangesNothing) {
  GainFilter filter;
  filter.Update({1.0f, 1.0f, 1.0f}, 0.0);
  const Gain once = filter.Update({2.0f, 2.0f, 2.0f}, 0.1);
  EXPECT_EQ(filter.Update({2.0f, 2.0f, 2.0f}, 0.1), once);
}

TEST(GainFilter, BeginsAnewAfterAResetAndWhenTimeGoesBack) {
  GainFilter filter;
  filter.Update({1.0f, 1.0f, 1.0f}, 1.0);
  filter.Reset();
  EXPECT_FLOAT_EQ(filter.Update({4.0f, 4.0f, 4.0f}, 1.01)[0], 4.0f);
  EXPECT_FLOAT_EQ(filter.Update({2.0f, 2.0f, 2.0f}, 0.5)[0], 2.0f);
}

}  // namespace
}  // namespace lararium::show
