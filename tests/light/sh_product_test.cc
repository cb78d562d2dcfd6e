#include "shared/light/sh_product.h"

#include <gtest/gtest.h>

#include "shared/light/quadrature.h"
#include "tests/light/sh_test_support.h"

namespace lararium::light {
namespace {

std::vector<float> RandomVector(Random& random, int count) {
  std::vector<float> values(static_cast<size_t>(count));
  for (float& value : values) {
    value = static_cast<float>(random.Normal());
  }
  return values;
}

// The projection of a product, summed over many directions.
std::vector<double> DenseProduct(const std::vector<float>& a,
                                 const std::vector<float>& b,
                                 size_t count) {
  constexpr int kDirections = 20000;
  std::vector<double> product(count);
  for (const glm::vec3& direction : EvenDirections(kDirections)) {
    const auto basis = EvaluateShBasis(direction);
    double left = 0.0, right = 0.0;
    for (size_t k = 0; k < a.size(); ++k) {
      left += static_cast<double>(a[k]) * basis[k];
    }
    for (size_t k = 0; k < b.size(); ++k) {
      right += static_cast<double>(b[k]) * basis[k];
    }
    for (size_t k = 0; k < count; ++k) {
      product[k] += left * right * basis[k] * 4.0 * std::numbers::pi / kDirections;
    }
  }
  return product;
}

class ShProduct : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Counts, ShProduct, testing::Values(4, 9, 16, 25, 36));

TEST_P(ShProduct, EqualsDenseQuadrature) {
  const int count = GetParam();
  Random random(21);
  const std::vector<float> a = RandomVector(random, count), b = RandomVector(random, count);
  std::vector<float> product(a.size());
  ShProductTable::ForCount(count).Multiply(a, b, product);
  const std::vector<double> dense = DenseProduct(a, b, a.size());
  for (size_t k = 0; k < dense.size(); ++k) {
    EXPECT_NEAR(product[k], dense[k], 3e-3) << "coefficient " << k;
  }
}

TEST_P(ShProduct, OfRegistersEqualsThatOfOne) {
  const int count = GetParam();
  const auto size = static_cast<size_t>(count);
  Random random(22);
  Lanes a[kShCount], b[kShCount], product[kShCount], square[kShCount];
  for (size_t k = 0; k < size; ++k) {
    for (size_t i = 0; i < kLanes; ++i) {
      a[k][i] = static_cast<float>(random.Normal());
      b[k][i] = static_cast<float>(random.Normal());
    }
  }
  const ShProductTable& table = ShProductTable::ForCount(count);
  table.Multiply(a, b, product);
  table.Square(a, square);
  for (size_t i = 0; i < kLanes; ++i) {
    std::vector<float> x(size), y(size), expected(size);
    for (size_t k = 0; k < size; ++k) {
      x[k] = a[k][i];
      y[k] = b[k][i];
    }
    table.Multiply(x, y, expected);
    for (size_t k = 0; k < size; ++k) {
      EXPECT_NEAR(product[k][i], expected[k], 2e-5);
    }
    table.Multiply(x, x, expected);
    for (size_t k = 0; k < size; ++k) {
      EXPECT_NEAR(square[k][i], expected[k], 2e-5);
    }
  }
}

TEST(ShProductTable, OneIsNeutralAndMostCoefficientsVanish) {
  Random random(23);
  const ShProductTable& table = ShProductTable::ForCount(16);
  EXPECT_LT(table.size(), 16u * 16u * 17u / 2u / 4u);
  const std::vector<float> a = RandomVector(random, 16);
  std::vector<float> one(16), product(16);
  one[0] = std::sqrt(4.0f * std::numbers::pi_v<float>);
  table.Multiply(a, one, product);
  for (size_t k = 0; k < 16; ++k) {
    EXPECT_NEAR(product[k], a[k], 1e-6);
  }
}

// Bands of the light beyond those of visibility count too.
TEST(LightMatrix, MultipliesWithAllBandsOfTheLight) {
  Random random(24);
  const ShRgb light = RandomCoefficients(random);
  const std::vector<float> visibility = RandomVector(random, 16);
  std::vector<float> green(kShCount);
  for (size_t k = 0; k < kShCount; ++k) {
    green[k] = light[k].g;
  }
  const std::vector<double> dense = DenseProduct(green, visibility, 16);
  const LightMatrix matrix(light, 16);
  for (size_t i = 0; i < 16; ++i) {
    double sum = 0.0;
    for (size_t j = 0; j < 16; ++j) {
      sum += matrix.channel(1)[i * 16 + j] * visibility[j];
    }
    EXPECT_NEAR(sum, dense[i], 3e-3);
  }
}

TEST(Quadrature, GaussLegendreIsExactForItsDegree) {
  for (int power = 0; power <= 9; ++power) {
    double sum = 0.0;
    for (const QuadratureNode& node : GaussLegendre(5, -0.5, 2.0)) {
      sum += node.weight * std::pow(node.at, power);
    }
    const double exact = (std::pow(2.0, power + 1) - std::pow(-0.5, power + 1)) / (power + 1);
    EXPECT_NEAR(sum, exact, 1e-12 * std::max(1.0, std::abs(exact)));
  }
}

}  // namespace
}  // namespace lararium::light
