#include "shared/core/random.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace lararium {
namespace {

TEST(Random, MatchesTheReferenceImplementation) {
  // The first outputs of the PCG32 demonstration program: seed 42, stream 54.
  Random random(42, 54);
  for (const uint32_t expected : {0xa15c02b7u, 0x7b47f409u, 0xba1d3330u, 0x83d2f293u}) {
    EXPECT_EQ(random.Next(), expected);
  }
}

TEST(Random, TheSeedDecides) {
  Random a(1);
  Random b(1);
  Random c(2);
  EXPECT_EQ(a.Next(), b.Next());
  EXPECT_NE(a.Next(), c.Next());
}

TEST(Random, BelowIsUniform) {
  Random random(3);
  std::array<int, 7> counts{};
  for (int i = 0; i < 70'000; ++i) {
    ++counts[random.Below(7)];
  }
  double chi_squared = 0.0;
  for (const int count : counts) {
    chi_squared += (count - 10'000.0) * (count - 10'000.0) / 10'000.0;
  }
  EXPECT_LT(chi_squared, 22.5);  // 99.9 % of 6 degrees of freedom
}

TEST(Random, UniformAndNormalHaveTheirMoments) {
  Random random(4);
  constexpr int kCount = 100'000;
  double uniform = 0.0;
  double normal = 0.0;
  double square = 0.0;
  for (int i = 0; i < kCount; ++i) {
    const double u = random.Uniform();
    ASSERT_GE(u, 0.0);
    ASSERT_LT(u, 1.0);
    const double n = random.Normal();
    ASSERT_TRUE(std::isfinite(n));
    uniform += u / kCount;
    normal += n / kCount;
    square += n * n / kCount;
  }
  EXPECT_NEAR(uniform, 0.5, 0.005);
  EXPECT_NEAR(normal, 0.0, 0.015);
  EXPECT_NEAR(square, 1.0, 0.02);
}

}  // namespace
}  // namespace lararium
