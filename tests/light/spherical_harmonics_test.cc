#include "shared/light/spherical_harmonics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <vector>

#include "shared/core/units.h"
#include "tests/light/sh_test_support.h"

namespace lararium::light {
namespace {

// Calls visit(direction, solid angle) for equal-angle cells that tile the sphere.
void ForEachDirection(int rows, const std::function<void(const glm::vec3&, double)>& visit) {
  for (int row = 0; row < rows; ++row) {
    const double polar = kPi * (row + 0.5) / rows;
    for (int column = 0; column < 2 * rows; ++column) {
      const double azimuth = kPi * (column + 0.5) / rows;
      visit(glm::vec3(std::sin(polar) * std::cos(azimuth), std::cos(polar),
                      std::sin(polar) * std::sin(azimuth)),
            std::sin(polar) * (kPi / rows) * (kPi / rows));
    }
  }
}

// Renders a function of direction into an image by the convention in the header, independently of
// the implementation.
std::vector<glm::vec3> Paint(int width,
                             int height,
                             const std::function<glm::vec3(const glm::vec3&)>& radiance) {
  std::vector<glm::vec3> pixels;
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width; ++column) {
      const double azimuth = 2.0 * kPi * ((column + 0.5) / width - 0.5);
      const double elevation = kPi * (0.5 - (row + 0.5) / height);
      const glm::vec3 forward(0.0f, 0.0f, -1.0f), right(1.0f, 0.0f, 0.0f), up(0.0f, 1.0f, 0.0f);
      const glm::vec3 level = static_cast<float>(std::cos(azimuth)) * forward +
                              static_cast<float>(std::sin(azimuth)) * right;
      pixels.push_back(radiance(static_cast<float>(std::cos(elevation)) * level +
                                static_cast<float>(std::sin(elevation)) * up));
    }
  }
  return pixels;
}

void ExpectNear(const ShRgb& a, const ShRgb& b, double tolerance) {
  for (int k = 0; k < kShCount; ++k) {
    for (int channel = 0; channel < 3; ++channel) {
      EXPECT_NEAR(a[k][channel], b[k][channel], tolerance) << "coefficient " << k;
    }
  }
}

TEST(SphericalHarmonics, BasisIsOrthonormal) {
  double products[kShCount][kShCount] = {};
  ForEachDirection(400, [&](const glm::vec3& direction, double solid_angle) {
    const auto basis = EvaluateShBasis(direction);
    for (int i = 0; i < kShCount; ++i) {
      for (int j = 0; j < kShCount; ++j) {
        products[i][j] += solid_angle * basis[i] * basis[j];
      }
    }
  });
  for (int i = 0; i < kShCount; ++i) {
    for (int j = 0; j < kShCount; ++j) {
      EXPECT_NEAR(products[i][j], i == j ? 1.0 : 0.0, 3e-4) << i << ", " << j;
    }
  }
}

TEST(SphericalHarmonics, SpansGetTheFirstBands) {
  const glm::vec3 direction = glm::normalize(glm::vec3(0.3f, -0.7f, 0.5f));
  const auto all = EvaluateShBasis(direction);
  for (const size_t count : {4, 9, 16, 25, 36}) {
    std::vector<float> basis(count);
    EvaluateShBasis(direction, basis);
    EXPECT_TRUE(std::equal(basis.begin(), basis.end(), all.begin())) << count;
  }
}

TEST(SphericalHarmonics, ZonalOnesAreLegendrePolynomials) {
  Random random(3);
  for (int i = 0; i < 20; ++i) {
    const glm::vec3 direction = RandomDirection(random);
    const auto basis = EvaluateShBasis(direction);
    for (unsigned l = 0; l <= kShDegree; ++l) {
      EXPECT_NEAR(basis[l * (l + 1)],
                  std::sqrt((2.0 * l + 1.0) / (4.0 * kPi)) * std::legendre(l, direction.z), 1e-5);
    }
  }
}

TEST(SphericalHarmonics, BasisIsOrderedByDegreeAndOrder) {
  // R&H 2001, equation 3: m = -1, 0, 1 is y, z, x; m = -2 is xy, m = 2 x^2 - y^2.
  EXPECT_NEAR(EvaluateShBasis({0, 1, 0})[1], std::sqrt(3.0 / (4.0 * kPi)), 1e-6);
  EXPECT_NEAR(EvaluateShBasis({0, 0, 1})[2], std::sqrt(3.0 / (4.0 * kPi)), 1e-6);
  EXPECT_NEAR(EvaluateShBasis({1, 0, 0})[3], std::sqrt(3.0 / (4.0 * kPi)), 1e-6);
  EXPECT_NEAR(EvaluateShBasis({0, 0, 1})[6], 2.0 * std::sqrt(5.0 / (16.0 * kPi)), 1e-6);
  EXPECT_NEAR(EvaluateShBasis({0, 1, 0})[8], -std::sqrt(15.0 / (16.0 * kPi)), 1e-6);
}

TEST(Projection, RecoversAConstant) {
  const auto pixels = Paint(64, 32, [](const glm::vec3&) { return glm::vec3(1.0f, 2.0f, 3.0f); });
  const ShRgb radiance = ProjectEquirectangular(pixels, 64, 32);
  EXPECT_NEAR(radiance[0].g, 2.0 * std::sqrt(4.0 * kPi), 1e-4);
  EXPECT_NEAR(EvaluateRadiance(radiance, {0.6f, -0.8f, 0.0f}).b, 3.0, 1e-2);
  EXPECT_NEAR(EvaluateIrradiance(radiance, {0.0f, 0.0f, 1.0f}).r, kPi, 1e-2);
}

TEST(Projection, PutsTheCentreForwardTheRightHalfRightAndTheTopUp) {
  const auto linear = [](const glm::vec3& d) {
    return glm::vec3(1.0f + d.x, 1.0f + d.y, 1.0f + d.z);
  };
  const ShRgb radiance = ProjectEquirectangular(Paint(128, 64, linear), 128, 64);
  const double unit = 1.0 / std::sqrt(3.0 / (4.0 * kPi));
  EXPECT_NEAR(radiance[3].r, unit, 2e-3);  // x
  EXPECT_NEAR(radiance[1].g, unit, 2e-3);  // y
  EXPECT_NEAR(radiance[2].b, unit, 2e-3);  // z
  EXPECT_NEAR(radiance[1].r, 0.0, 1e-4);
  EXPECT_NEAR(radiance[2].g, 0.0, 1e-4);
  EXPECT_NEAR(radiance[3].b, 0.0, 1e-4);
}

TEST(Projection, RecoversEveryBandLimitedFunction) {
  Random random(7);
  const ShRgb expected = RandomCoefficients(random);
  const auto pixels =
      Paint(512, 256, [&](const glm::vec3& d) { return EvaluateRadiance(expected, d); });
  ExpectNear(ProjectEquirectangular(pixels, 512, 256), expected, 2e-3);
}

TEST(Irradiance, OfBandLimitedLightEqualsTheIntegral) {
  Random random(8);
  ShRgb radiance = RandomCoefficients(random);
  radiance[0] += 40.0f;  // Keeps the irradiance positive.
  for (int trial = 0; trial < 5; ++trial) {
    const glm::vec3 normal = RandomDirection(random);
    glm::dvec3 integral(0.0);
    ForEachDirection(200, [&](const glm::vec3& d, double solid_angle) {
      const double cosine = std::max(0.0f, glm::dot(d, normal));
      integral += solid_angle * cosine * glm::dvec3(EvaluateRadiance(radiance, d));
    });
    const glm::vec3 irradiance = EvaluateIrradiance(radiance, normal);
    for (int channel = 0; channel < 3; ++channel) {
      EXPECT_NEAR(irradiance[channel], integral[channel], 2e-3 * integral[channel]);
    }
  }
}

TEST(Irradiance, OfOneDirectionIsWithinTheErrorOfDegreeFive) {
  // A distant light gives max(0, n.l). Without the bands from 6 up the error is
  // largest at right angles: 1/4 - 5/32 - 9/256 = 0.0586.
  const glm::vec3 light = glm::normalize(glm::vec3(0.3f, 0.8f, -0.5f));
  const auto basis = EvaluateShBasis(light);
  ShRgb radiance;
  for (int k = 0; k < kShCount; ++k) {
    radiance[k] = glm::vec3(basis[k]);
  }
  Random random(9);
  for (int trial = 0; trial < 200; ++trial) {
    const glm::vec3 normal = RandomDirection(random);
    const double expected = std::max(0.0f, glm::dot(normal, light));
    EXPECT_NEAR(EvaluateIrradiance(radiance, normal).r, expected, 0.0587);
  }
}

TEST(Irradiance, IsNeverNegative) {
  const auto basis = EvaluateShBasis({0.0f, 1.0f, 0.0f});
  ShRgb radiance;
  for (int k = 0; k < kShCount; ++k) {
    radiance[k] = glm::vec3(basis[k]);
  }
  for (int degree = 0; degree <= 180; ++degree) {
    const double angle = degree * kPi / 180.0;
    EXPECT_GE(EvaluateIrradiance(radiance, {std::sin(angle), std::cos(angle), 0.0}).g, 0.0f);
  }
}

TEST(RotateSh, EqualsRotatingTheFunction) {
  Random random(10);
  for (int trial = 0; trial < 20; ++trial) {
    const ShRgb radiance = RandomCoefficients(random);
    const glm::quat rotation = RandomRotation(random);
    const ShRgb rotated = RotateSh(radiance, rotation);
    for (int i = 0; i < 10; ++i) {
      const glm::vec3 direction = RandomDirection(random);
      const glm::vec3 a = EvaluateRadiance(rotated, direction);
      const glm::vec3 b = EvaluateRadiance(radiance, glm::inverse(rotation) * direction);
      EXPECT_NEAR(glm::distance(a, b), 0.0, 5e-5);
    }
  }
}

TEST(RotateSh, ComposesAndInverts) {
  Random random(11);
  const ShRgb radiance = RandomCoefficients(random);
  const glm::quat a = RandomRotation(random);
  const glm::quat b = RandomRotation(random);
  ExpectNear(RotateSh(RotateSh(radiance, a), b), RotateSh(radiance, b * a), 1e-5);
  ExpectNear(RotateSh(RotateSh(radiance, a), glm::inverse(a)), radiance, 1e-5);
}

TEST(RotateSh, MatricesAreOrthogonal) {
  Random random(12);
  for (int trial = 0; trial < 10; ++trial) {
    const ShRotation rotation(RandomRotation(random));
    for (int l = 0; l <= kShDegree; ++l) {
      const size_t side = static_cast<size_t>(2 * l + 1);
      const std::span<const float> matrix = rotation.band(l);
      ASSERT_EQ(matrix.size(), side * side);
      for (size_t i = 0; i < side; ++i) {
        for (size_t j = 0; j < side; ++j) {
          double product = 0.0;
          for (size_t k = 0; k < side; ++k) {
            product += static_cast<double>(matrix[i * side + k]) * matrix[j * side + k];
          }
          EXPECT_NEAR(product, i == j ? 1.0 : 0.0, 2e-6) << "degree " << l;
        }
      }
    }
  }
}

TEST(RotateSh, EqualsProjectingTheRotatedFunction) {
  Random random(13);
  const ShRgb radiance = RandomCoefficients(random);
  const glm::quat rotation = RandomRotation(random);
  const auto pixels = Paint(512, 256, [&](const glm::vec3& d) {
    return EvaluateRadiance(radiance, glm::inverse(rotation) * d);
  });
  ExpectNear(ProjectEquirectangular(pixels, 512, 256), RotateSh(radiance, rotation), 2e-3);
}

TEST(RotateSh, QuarterTurnLeftMovesLightFromForwardToLeft) {
  const auto basis = EvaluateShBasis({0.0f, 0.0f, -1.0f});
  ShRgb forward;
  for (int k = 0; k < kShCount; ++k) {
    forward[k] = glm::vec3(basis[k]);
  }
  const glm::quat left = glm::angleAxis(static_cast<float>(kPi / 2.0), glm::vec3(0, 1, 0));
  const auto expected = EvaluateShBasis({-1.0f, 0.0f, 0.0f});
  const ShRgb rotated = RotateSh(forward, left);
  for (int k = 0; k < kShCount; ++k) {
    EXPECT_NEAR(rotated[k].r, expected[k], 1e-6);
  }
}

}  // namespace
}  // namespace lararium::light
