#include "shared/light/blocker_table.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "shared/core/units.h"
#include "tests/light/sh_test_support.h"

namespace lararium::light {
namespace {

// Visibility past balls, seen from the origin, projected by casting rays.
std::vector<double> CastVisibility(const std::vector<Ball>& balls, size_t count, int rays) {
  std::vector<double> sums(count);
  for (const glm::vec3& ray : EvenDirections(rays)) {
    bool visible = true;
    for (const Ball& ball : balls) {
      const float along = glm::dot(ball.centre, ray);
      const float beside2 = glm::dot(ball.centre, ball.centre) - along * along;
      visible = visible && !(along > 0.0f && beside2 < ball.radius * ball.radius);
    }
    if (visible) {
      const auto basis = EvaluateShBasis(ray);
      for (size_t k = 0; k < count; ++k) {
        sums[k] += basis[k] * 4.0 * kPi / rays;
      }
    }
  }
  return sums;
}

// Root mean square over the sphere of the difference of two functions.
double Distance(const ShRows& rows, const std::vector<double>& other) {
  double sum = 0.0;
  for (int k = 0; k < rows.count(); ++k) {
    const double difference = rows.at(k, 0) - other[static_cast<size_t>(k)];
    sum += difference * difference;
  }
  return std::sqrt(sum / (4.0 * kPi));
}

ShRows Visibility(const std::vector<Ball>& balls, int count) {
  const BallArrays arrays(balls);
  const PointArrays points({glm::vec3(0.0f)});
  ShRows log(count, 1), visibility(count, 1);
  AddLogVisibility(arrays.spheres(), points.points(), {0, 1}, log);
  ExpRows(log, visibility);
  return visibility;
}

std::vector<Ball> RandomBalls(Random& random, int number, float widest) {
  std::vector<Ball> balls;
  for (int i = 0; i < number; ++i) {
    const auto distance = static_cast<float>(random.Uniform(0.5, 3.0));
    const auto angle = static_cast<float>(random.Uniform(0.1, 1.0)) * widest;
    balls.push_back({RandomDirection(random) * distance, distance * std::sin(angle)});
  }
  return balls;
}

class Exponential : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Counts, Exponential, testing::Values(9, 16, 25));

TEST_P(Exponential, OfNothingIsOne) {
  const ShRows visibility = Visibility({}, GetParam());
  EXPECT_NEAR(visibility.at(0, 0), std::sqrt(4.0 * kPi), 1e-5);
  for (int k = 1; k < GetParam(); ++k) {
    EXPECT_NEAR(visibility.at(k, 0), 0.0, 1e-6);
  }
}

// Compares with the analytic projection: a single ball is right unless it is huge.
TEST_P(Exponential, OfOneBallIsItsVisibility) {
  const auto count = static_cast<size_t>(GetParam());
  const glm::vec3 direction = glm::normalize(glm::vec3(0.5f, -0.3f, 0.8f));
  const auto basis = EvaluateShBasis(direction);
  for (const double angle : {0.1, 0.2, 0.4, 0.6, 0.8, 0.9}) {
    std::vector<double> expected(count);
    for (size_t k = 0; k < count; ++k) {
      const int l = ShBandOf(static_cast<int>(k));
      expected[k] = ZonalVisibility(l, angle) * std::sqrt(4.0 * kPi / (2.0 * l + 1.0)) * basis[k];
    }
    const ShRows visibility =
        Visibility({{2.0f * direction, 2.0f * static_cast<float>(std::sin(angle))}}, GetParam());
    const double distance = Distance(visibility, expected);
    std::printf("  %zu coefficients, angular radius %.1f: rms %.4f\n", count, angle, distance);
    EXPECT_LT(distance, angle < 0.7 ? 0.004 : 0.045) << angle;
  }
}

// Ren et al. 2006 add logs as if blockers were independent within the band limit, so there is an
// error where balls overlap or crowd.
TEST_P(Exponential, OfManyBallsIsCloseToCastRays) {
  const auto count = static_cast<size_t>(GetParam());
  const struct {
    int balls;
    float widest;
    double bound;
  } kCases[] = {
      {2, 0.6f, 0.02}, {4, 0.6f, 0.04}, {10, 0.5f, 0.06}, {40, 0.35f, 0.08}, {3, 1.2f, 0.07}};
  Random random(31);
  for (const auto& test : kCases) {
    double squared = 0.0, unshadowed = 0.0, mean_error = 0.0;
    constexpr int kTrials = 12;
    for (int trial = 0; trial < kTrials; ++trial) {
      const std::vector<Ball> balls = RandomBalls(random, test.balls, test.widest);
      const std::vector<double> cast = CastVisibility(balls, count, 4000);
      const ShRows visibility = Visibility(balls, GetParam());
      squared += std::pow(Distance(visibility, cast), 2) / kTrials;
      unshadowed += std::pow(Distance(Visibility({}, GetParam()), cast), 2) / kTrials;
      mean_error += (visibility.at(0, 0) - cast[0]) / std::sqrt(4.0 * kPi) / kTrials;
    }
    std::printf(
        "  %zu coefficients, %2d balls to %.2f rad: rms %.4f (unshadowed %.4f), mean %+.4f\n",
        count, test.balls, test.widest, std::sqrt(squared), std::sqrt(unshadowed), mean_error);
    EXPECT_LT(std::sqrt(squared), test.bound);
    EXPECT_LT(std::sqrt(squared), 0.3 * std::sqrt(unshadowed));
  }
}

// Many balls at the skin give very large logs; the result must be dark, not bright.
TEST_P(Exponential, OfACrowdOfBallsThatTouchIsDark) {
  Random random(33);
  for (const int number : {5, 20, 60}) {
    std::vector<Ball> balls;
    for (int i = 0; i < number; ++i) {
      balls.push_back({RandomDirection(random) * 1.05f, 1.0f});
    }
    const ShRows visibility = Visibility(balls, GetParam());
    EXPECT_LT(visibility.at(0, 0) / std::sqrt(4.0 * kPi), 0.15) << number;
    for (int k = 0; k < GetParam(); ++k) {
      EXPECT_LT(std::abs(visibility.at(k, 0)) / std::sqrt(4.0 * kPi), 0.15) << number << " " << k;
    }
  }
}

TEST(BlockerTable, AngularRadiusIsThatOfTheBallAndSaturatesSmoothly) {
  for (const double sine : {0.05, 0.3, 0.6, 0.8}) {
    const double share = sine * sine / (1.0 + sine * sine);
    EXPECT_NEAR(BlockerTable::AngularRadius(share), std::asin(sine), 0.01) << sine;
  }
  double before = 0.0;
  for (int i = 0; i <= 1000; ++i) {
    const double angle = BlockerTable::AngularRadius(i / 1000.0);
    EXPECT_GE(angle, before);
    EXPECT_LT(i < 2 ? 0.0 : angle - before, 0.02) << i;
    before = angle;
  }
  EXPECT_NEAR(before, BlockerTable::kMaxAngularRadius, 1e-3);
}

template <int Degree>
void ExpectRegistersGetWhatOneGets(int count) {
  const BlockerTable& table = BlockerTable::ForCount(count);
  const Lanes share = {0.0f, 0.001f, 0.1f, 0.123f, 0.5f, 0.77f, 0.9999f, 1.0f};
  Lanes factors[Degree + 1];
  table.At<Degree>(share, factors);
  for (size_t i = 0; i < kLanes; ++i) {
    const BlockerTable::Factors one = table.At(share[i]);
    for (size_t l = 0; l <= Degree; ++l) {
      EXPECT_NEAR(factors[l][i], one[l], 1e-5) << count << " " << share[i];
    }
  }
}

TEST(BlockerTable, RegistersGetWhatOneGets) {
  ExpectRegistersGetWhatOneGets<2>(9);
  ExpectRegistersGetWhatOneGets<3>(16);
  ExpectRegistersGetWhatOneGets<4>(25);
}

TEST(BlockerTable, HasNoLeaps) {
  for (const int count : {9, 16, 25}) {
    const BlockerTable& table = BlockerTable::ForCount(count);
    for (int i = 0; i < 1024; ++i) {
      const auto a = table.At(i / 1024.0f), b = table.At((i + 1) / 1024.0f);
      for (int l = 0; l <= table.degree(); ++l) {
        const auto band = static_cast<size_t>(l);
        EXPECT_LT(std::abs(a[band] - b[band]), 0.25f)
            << count << " entry " << i / 4 << " degree " << l;
      }
    }
  }
}

TEST(Lanes, ExponentialIsThatOfTheLibrary) {
  Random random(32);
  for (int trial = 0; trial < 100; ++trial) {
    Lanes a;
    for (size_t i = 0; i < kLanes; ++i) {
      a[i] = static_cast<float>(random.Uniform(-20.0, 20.0));
    }
    const Lanes result = Exp(a);
    for (size_t i = 0; i < kLanes; ++i) {
      EXPECT_NEAR(result[i] / std::exp(static_cast<double>(a[i])), 1.0, 3e-6);
    }
  }
}

}  // namespace
}  // namespace lararium::light
