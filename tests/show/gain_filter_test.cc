#include "shared/show/gain_filter.h"

#include <gtest/gtest.h>

#include <cmath>

#include "shared/core/random.h"

namespace lararium::show {
namespace {

using Gain = std::array<float, 3>;

float Stops(double stops) { return static_cast<float>(std::exp2(stops)); }

TEST(GainFilter, TakesTheFirstGainAsItIs) {
  GainFilter filter;
  const Gain gain = filter.Update({0.5f, 1.0f, 2.0f}, 7.0);
  EXPECT_FLOAT_EQ(gain[0], 0.5f);
  EXPECT_FLOAT_EQ(gain[1], 1.0f);
  EXPECT_FLOAT_EQ(gain[2], 2.0f);
}

TEST(GainFilter, DoesNotLagBehindAnEvenChangeAtAnyFrameRate) {
  // Four stops a second, the fastest exposure change of phones.
  for (const double rate : {10.0, 30.0, 60.0, 144.0}) {
    GainFilter filter;
    for (int i = 0; i <= static_cast<int>(rate); ++i) {
      const double time = i / rate;
      const Gain gain = filter.Update({Stops(4.0 * time), Stops(-2.0 * time), 1.0f}, time);
      if (time > 0.6) {
        EXPECT_NEAR(std::log2(gain[0]), 4.0 * time, 0.01) << rate << " per second";
        EXPECT_NEAR(std::log2(gain[1]), -2.0 * time, 0.01) << rate << " per second";
      }
      EXPECT_NEAR(gain[2], 1.0f, 1e-6f);
    }
  }
}

TEST(GainFilter, FollowsExposureThatSwingsAsInTheMaquette) {
  // 1.5 stops up and down in two seconds, with a hundredth of a stop of noise.
  GainFilter filter;
  Random random(6);
  double squares = 0.0;
  for (int i = 0; i < 300; ++i) {
    const double time = i / 30.0;
    const double truth = 1.5 * std::sin(2.0 * 3.14159265 * time / 2.0);
    const float noisy = Stops(truth + 0.01 * random.Normal());
    const double off = std::log2(filter.Update({noisy, noisy, noisy}, time)[0]) - truth;
    squares += off * off;
  }
  EXPECT_LT(std::sqrt(squares / 300.0), 0.06) << "seed 6";
}

TEST(GainFilter, StepsAreOverAfterAFifthOfASecond) {
  GainFilter filter;
  filter.Update({1.0f, 1.0f, 1.0f}, 0.0);
  for (int i = 1; i <= 30; ++i) {
    const double stops = std::log2(filter.Update({Stops(0.4), 1.0f, 1.0f}, i / 30.0)[0]);
    EXPECT_LT(stops, 0.4 * 1.12);
    if (i >= 6) {
      EXPECT_NEAR(stops, 0.4, 0.4 * 0.06) << i;
    }
  }
}

TEST(GainFilter, JumpsAreTakenAtOnce) {
  GainFilter filter;
  filter.Update({1.0f, 1.0f, 1.0f}, 0.0);
  filter.Update({1.0f, 1.0f, 1.0f}, 0.03);
  EXPECT_FLOAT_EQ(filter.Update({4.0f, 1.0f, 1.0f}, 0.06)[0], 4.0f);
}

TEST(GainFilter, LessensNoiseOfSingleFrames) {
  GainFilter filter;
  Random random(8);
  double in = 0.0;
  double out = 0.0;
  double before_in = 0.0;
  double before_out = 0.0;
  for (int i = 0; i < 2000; ++i) {
    const double noise = 0.02 * random.Normal();
    const float noisy = static_cast<float>(std::exp(noise));
    const double steadied = std::log(filter.Update({noisy, noisy, noisy}, i / 30.0)[0]);
    if (i > 100) {
      in += (noise - before_in) * (noise - before_in);
      out += (steadied - before_out) * (steadied - before_out);
    }
    before_in = noise;
    before_out = steadied;
  }
  EXPECT_LT(std::sqrt(out / in), 0.65) << "seed 8";
}

TEST(GainFilter, TheSameFrameAgainChangesNothing) {
  GainFilter filter;
  filter.Update({1.0f, 1.0f, 1.0f}, 0.0);
  const Gain once = filter.Update({1.2f, 1.2f, 1.2f}, 0.1);
  EXPECT_EQ(filter.Update({1.2f, 1.2f, 1.2f}, 0.1), once);
}

TEST(GainFilter, BeginsAnewAfterAResetAndWhenTimeGoesBack) {
  GainFilter filter;
  filter.Update({1.0f, 1.0f, 1.0f}, 1.0);
  filter.Reset();
  EXPECT_FLOAT_EQ(filter.Update({1.3f, 1.3f, 1.3f}, 1.01)[0], 1.3f);
  EXPECT_FLOAT_EQ(filter.Update({1.1f, 1.1f, 1.1f}, 0.5)[0], 1.1f);
}

}  // namespace
}  // namespace lararium::show
