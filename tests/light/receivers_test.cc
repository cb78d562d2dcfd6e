#include "shared/light/receivers.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "shared/light/blocker_table.h"
#include "tests/light/sh_test_support.h"

namespace lararium::light {
namespace {

constexpr size_t kReceiverCount = 37;  // no multiple of the register size

std::vector<glm::vec3> RandomPoints(Random& random, size_t count) {
  std::vector<glm::vec3> points;
  for (size_t i = 0; i < count; ++i) {
    points.push_back({random.Uniform(-1, 1), random.Uniform(0, 2), random.Uniform(-1, 1)});
  }
  return points;
}

std::vector<Ball> RandomBalls(Random& random, size_t count) {
  std::vector<Ball> balls;
  for (const glm::vec3& point : RandomPoints(random, count)) {
    balls.push_back({2.0f * point, static_cast<float>(random.Uniform(0.05, 0.3))});
  }
  return balls;
}

// The log of one ball from the table and the basis, without registers.
std::vector<float> LogOf(const Ball& ball, const glm::vec3& receiver, int count) {
  const BlockerTable& table = BlockerTable::ForCount(count);
  const glm::vec3 d = ball.centre - receiver;
  const float share = ball.radius * ball.radius / (glm::dot(d, d) + ball.radius * ball.radius);
  const auto factors = table.At(share < kLeastShare ? 0.0f : share);
  const auto basis = EvaluateShBasis(glm::normalize(d));
  std::vector<float> log(static_cast<size_t>(count));
  for (int k = 0; k < count; ++k) {
    log[static_cast<size_t>(k)] =
        factors[static_cast<size_t>(ShBandOf(k))] * basis[static_cast<size_t>(k)];
  }
  return log;
}

class ReceiverSet : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Counts, ReceiverSet, testing::Values(9, 16, 25));

TEST_P(ReceiverSet, LogsAddUpBallByBall) {
  Random random(41);
  const std::vector<glm::vec3> points = RandomPoints(random, kReceiverCount);
  std::vector<Ball> balls = RandomBalls(random, 12);
  ShRows log(GetParam(), kReceiverCount);
  const PointArrays at(points);
  const BallArrays arrays(balls);
  AddLogVisibility(arrays.spheres(), at.points(), {0, kReceiverCount}, log);
  for (size_t i = 0; i < kReceiverCount; ++i) {
    std::vector<float> expected(static_cast<size_t>(GetParam()));
    for (const Ball& ball : balls) {
      const std::vector<float> one = LogOf(ball, points[i], GetParam());
      std::transform(one.begin(), one.end(), expected.begin(), expected.begin(), std::plus<>());
    }
    for (int k = 0; k < GetParam(); ++k) {
      EXPECT_NEAR(log.at(k, i), expected[static_cast<size_t>(k)], 3e-3) << i << " " << k;
    }
  }
}

TEST_P(ReceiverSet, RangesGiveTheSameAsAllAtOnce) {
  Random random(42);
  const PointArrays at(RandomPoints(random, kReceiverCount));
  const BallArrays balls(RandomBalls(random, 5));
  ShRows whole(GetParam(), kReceiverCount), parts(GetParam(), kReceiverCount);
  AddLogVisibility(balls.spheres(), at.points(), {0, kReceiverCount}, whole);
  AddLogVisibility(balls.spheres(), at.points(), {16, kReceiverCount}, parts);
  AddLogVisibility(balls.spheres(), at.points(), {0, 16}, parts);
  for (int k = 0; k < GetParam(); ++k) {
    for (size_t i = 0; i < kReceiverCount; ++i) {
      EXPECT_EQ(whole.at(k, i), parts.at(k, i));
    }
  }
}

// If the whole scene is rotated, the result rotates with it.
TEST_P(ReceiverSet, TurnWithTheScene) {
  Random random(43);
  std::vector<glm::vec3> points = RandomPoints(random, kReceiverCount);
  std::vector<Ball> balls = RandomBalls(random, 6);
  const glm::quat turn = RandomRotation(random);
  ShRows log(GetParam(), kReceiverCount), turned(GetParam(), kReceiverCount),
      direct(GetParam(), kReceiverCount);
  AddLogVisibility(BallArrays(balls).spheres(), PointArrays(points).points(), {0, kReceiverCount},
                   log);
  const TurnArrays turns(std::vector<glm::quat>(kReceiverCount, turn));
  TurnRows(log, turns.turns(), TurnDirection::kForth, {0, kReceiverCount}, turned);
  for (glm::vec3& point : points) {
    point = turn * point;
  }
  for (Ball& ball : balls) {
    ball.centre = turn * ball.centre;
  }
  AddLogVisibility(BallArrays(balls).spheres(), PointArrays(points).points(), {0, kReceiverCount},
                   direct);
  for (int k = 0; k < GetParam(); ++k) {
    for (size_t i = 0; i < kReceiverCount; ++i) {
      EXPECT_NEAR(turned.at(k, i), direct.at(k, i), 2e-3);
    }
  }
}

// Each receiver has its own frame; the expected value is the log in stage axes, rotated back.
TEST_P(ReceiverSet, SeeInTheirOwnFrames) {
  Random random(46);
  const PointArrays at(RandomPoints(random, kReceiverCount));
  const BallArrays balls(RandomBalls(random, 6));
  std::vector<glm::quat> own;
  std::generate_n(std::back_inserter(own), kReceiverCount, [&] { return RandomRotation(random); });
  const TurnArrays turns(own);
  ShRows log(GetParam(), kReceiverCount), turned(GetParam(), kReceiverCount),
      direct(GetParam(), kReceiverCount);
  AddLogVisibility(balls.spheres(), at.points(), {0, kReceiverCount}, log);
  TurnRows(log, turns.turns(), TurnDirection::kBack, {0, kReceiverCount}, turned);
  AddLogVisibility(balls.spheres(), at.points(), turns.turns(), {0, kReceiverCount}, direct);
  for (int k = 0; k < GetParam(); ++k) {
    for (size_t i = 0; i < kReceiverCount; ++i) {
      EXPECT_NEAR(turned.at(k, i), direct.at(k, i), 2e-5);
    }
  }
}

TEST_P(ReceiverSet, ShadowedLightIsVisibilityTimesLight) {
  Random random(44);
  const int count = GetParam();
  ShRgb light = RandomCoefficients(random);
  for (size_t k = static_cast<size_t>(count); k < kShCount; ++k) {
    light[k] = glm::vec3(0.0f);
  }
  const PointArrays at(RandomPoints(random, kReceiverCount));
  const BallArrays balls(RandomBalls(random, 6));
  ShRows log(count, kReceiverCount), visibility(count, kReceiverCount);
  ShRowsRgb shadowed = {ShRows(count, kReceiverCount), ShRows(count, kReceiverCount),
                        ShRows(count, kReceiverCount)};
  AddLogVisibility(balls.spheres(), at.points(), {0, kReceiverCount}, log);
  ExpRows(log, visibility);
  ShadowLight(LightMatrix(light, count), log, {0, kReceiverCount}, shadowed);
  const auto size = static_cast<size_t>(count);
  for (size_t i = 0; i < kReceiverCount; ++i) {
    for (int channel = 0; channel < 3; ++channel) {
      std::vector<float> l(size), v(size), product(size);
      for (size_t k = 0; k < size; ++k) {
        l[k] = light[k][channel];
        v[k] = visibility.at(static_cast<int>(k), i);
      }
      ShProductTable::ForCount(count).Multiply(l, v, product);
      for (size_t k = 0; k < size; ++k) {
        EXPECT_NEAR(shadowed[static_cast<size_t>(channel)].at(static_cast<int>(k), i), product[k],
                    1e-4);
      }
    }
  }
}

TEST_P(ReceiverSet, UnshadowedLightIsTheLight) {
  Random random(45);
  const ShRgb light = RandomCoefficients(random);
  ShRows log(GetParam(), kReceiverCount);
  ShRowsRgb lit = {ShRows(GetParam(), kReceiverCount), ShRows(GetParam(), kReceiverCount),
                   ShRows(GetParam(), kReceiverCount)};
  ShadowLight(LightMatrix(light, GetParam()), log, {0, kReceiverCount}, lit);
  for (int k = 0; k < GetParam(); ++k) {
    EXPECT_NEAR(lit[2].at(k, 7), light[static_cast<size_t>(k)].b, 2e-5);
  }
}

// A ball hides about q / 4 of the sky; the fade removes at most kLeastShare / 4.
TEST_P(ReceiverSet, WhatDistantBallsLoseIsBoundedAndComesGradually) {
  const PointArrays at({glm::vec3(0.0f)});
  const glm::vec3 direction = glm::normalize(glm::vec3(1.0f, 2.0f, -0.5f));
  double before = 0.0;
  for (int i = 400; i >= 1; --i) {
    const Ball ball = {direction * (0.02f * static_cast<float>(i) + 1.0f), 0.1f};
    ShRows log(GetParam(), 1), visibility(GetParam(), 1);
    AddLogVisibility(BallArrays({ball}).spheres(), at.points(), {0, 1}, log);
    ExpRows(log, visibility);
    const double sine = ball.radius / glm::length(ball.centre);
    const double hidden = 1.0 - visibility.at(0, 0) / std::sqrt(4.0 * std::numbers::pi);
    const double exact = 0.5 * (1.0 - std::sqrt(1.0 - sine * sine));
    EXPECT_NEAR(hidden, exact, kLeastShare / 4.0 + 0.02 * exact + 1e-6) << i;
    EXPECT_GT(hidden, before - 1e-6);
    EXPECT_LT(hidden - before, 2e-4);
    before = hidden;
  }
}

TEST_P(ReceiverSet, BallsThatAreNotFiniteHideNothing) {
  const PointArrays at({glm::vec3(0.0f)});
  ShRows expected(GetParam(), 1), log(GetParam(), 1);
  const Ball good = {{0.0f, 1.0f, 0.0f}, 0.3f};
  AddLogVisibility(BallArrays({good}).spheres(), at.points(), {0, 1}, expected);
  const BallArrays balls({good,
                          {{NAN, 1.0f, 0.0f}, 0.3f},
                          {{0.0f, INFINITY, 0.0f}, 0.3f},
                          {{0.0f, 1.0f, 0.0f}, NAN},
                          {{0.0f, 1.0f, 0.0f}, INFINITY},
                          {{0.0f, 1.0f, 0.0f}, 0.0f}});
  AddLogVisibility(balls.spheres(), at.points(), {0, 1}, log);
  for (int k = 0; k < GetParam(); ++k) {
    EXPECT_EQ(log.at(k, 0), expected.at(k, 0));
  }
}

TEST_P(ReceiverSet, InsideABallNothingLeaps) {
  double before = -1.0;
  for (int i = 0; i <= 200; ++i) {
    const PointArrays at({glm::vec3(0.0f, 0.01f * static_cast<float>(i), 0.0f)});
    ShRows log(GetParam(), 1), visibility(GetParam(), 1);
    AddLogVisibility(BallArrays({{glm::vec3(0.0f), 1.0f}}).spheres(), at.points(), {0, 1}, log);
    ExpRows(log, visibility);
    const double seen = visibility.at(0, 0) / std::sqrt(4.0 * std::numbers::pi);
    EXPECT_TRUE(std::isfinite(seen));
    EXPECT_GT(seen, 0.0);
    EXPECT_LT(seen, 1.0);
    EXPECT_LT(before < 0.0 ? 0.0 : std::abs(seen - before), 0.02) << i;
    before = seen;
  }
}

}  // namespace
}  // namespace lararium::light
