#include "editor/bake/environment.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "editor/bake/directions.h"
#include "tests/bake/test_surfaces.h"

namespace lararium::bake {
namespace {

const glm::quat kTurned = glm::angleAxis(1.1f, glm::normalize(glm::vec3(1.0f, 2.0f, -0.5f)));

// A probe with all values between dark and bright, a small lamp, and one dark row.
ProbeImage MakeUnevenProbe() {
  ProbeImage image = MakeProbe(32, [](const glm::vec3& d) {
    const float lamp = d.x > 0.85f && d.y > 0.2f && d.y < 0.4f ? 60.0f : 0.0f;
    return glm::vec3(1.0f + d.y, 1.0f + 0.5f * d.x, 0.7f) + lamp;
  });
  for (int column = 0; column < image.width; ++column) {
    image.pixels[static_cast<size_t>(13 * image.width + column)] = glm::vec3(0.0f);
  }
  return image;
}

// Calls visit(direction, solid angle) over the sphere, several times per texel.
template <typename Visit>
void OverTheSphere(int width, const Visit& visit) {
  const int height = width / 2;
  for (int row = 0; row < height; ++row) {
    const float e = kPiF * (0.5f - (static_cast<float>(row) + 0.5f) / height);
    const float top = kPiF * (0.5f - static_cast<float>(row) / height);
    const float solid_angle = 2.0f * kPiF / width * (std::sin(top) - std::sin(top - kPiF / height));
    for (int column = 0; column < width; ++column) {
      const float a = 2.0f * kPiF * ((static_cast<float>(column) + 0.5f) / width - 0.5f);
      visit(glm::vec3(std::cos(e) * std::sin(a), std::sin(e), -std::cos(e) * std::cos(a)),
            solid_angle);
    }
  }
}

glm::vec2 GridPoint(int i, int side) {
  return {(static_cast<float>(i % side) + 0.5f) / static_cast<float>(side),
          (static_cast<float>(i / side) + 0.5f) / static_cast<float>(side)};
}

TEST(Environment, TexelCentresGiveTheirTexelsTurnedAndScaled) {
  const ProbeImage image = MakeUnevenProbe();
  const Environment environment(image, {kTurned, 2.5f});
  const Environment plain(image, {});
  size_t texel = 0;
  OverTheSphere(image.width, [&](const glm::vec3& in_probe, float) {
    const glm::vec3 expected = image.pixels[texel++];
    EXPECT_LT(glm::distance(plain.Radiance(in_probe), expected), 1e-3f) << texel;
    EXPECT_LT(glm::distance(environment.Radiance(kTurned * in_probe), 2.5f * expected), 5e-3f);
  });
}

TEST(Environment, RadianceIsContinuousAcrossTheSeamAndFiniteAtThePoles) {
  const Environment environment(MakeUnevenProbe(), {});
  const glm::vec3 left = environment.Radiance(glm::normalize(glm::vec3(-1e-5f, 0.1f, 1.0f)));
  const glm::vec3 right = environment.Radiance(glm::normalize(glm::vec3(1e-5f, 0.1f, 1.0f)));
  EXPECT_LT(glm::distance(left, right), 1e-3f);
  for (const float y : {-1.0f, 1.0f}) {
    const glm::vec3 pole = environment.Radiance({0.0f, y, 0.0f});
    EXPECT_TRUE(std::isfinite(pole.r + pole.g + pole.b));
    EXPECT_GT(environment.Density({0.0f, y, 0.0f}), 0.0f);
  }
}

TEST(Environment, DensityIntegratesToOne) {
  for (const Environment& environment :
       {Environment(MakeUnevenProbe(), {kTurned, 2.0f}), Environment(MakeUniformProbe(3.0f), {})}) {
    double sum = 0.0;
    OverTheSphere(256, [&](const glm::vec3& direction, float solid_angle) {
      sum += static_cast<double>(environment.Density(kTurned * direction)) * solid_angle;
    });
    EXPECT_NEAR(sum, 1.0, 2e-3);
  }
}

TEST(Environment, AUniformProbeIsDrawnUniformly) {
  const Environment environment(MakeUniformProbe(3.0f), {});
  OverTheSphere(32, [&](const glm::vec3& direction, float) {
    // Rows are weighted by the cosine at their middle, not by their exact solid angle.
    EXPECT_NEAR(environment.Density(direction), 1.0f / (4.0f * kPiF), 0.01f / (4.0f * kPiF));
  });
}

TEST(Environment, DrawsCarryTheirOwnDensity) {
  const Environment environment(MakeUnevenProbe(), {kTurned, 1.0f});
  constexpr int kSide = 128;
  int differing = 0;
  for (int i = 0; i < kSide * kSide; ++i) {
    const Environment::Sample sample = environment.Draw(GridPoint(i, kSide));
    ASSERT_NEAR(glm::length(sample.direction), 1.0f, 1e-4f);
    ASSERT_GT(sample.density, 0.0f);
    const float again = environment.Density(sample.direction);
    differing += std::abs(again - sample.density) > 1e-3f * sample.density;
  }
  // Directions on the border of two texels may belong to either.
  EXPECT_LT(differing, kSide * kSide / 500);
}

TEST(Environment, DrawsFallWhereTheDensityIs) {
  const ProbeImage image = MakeUnevenProbe();
  const Environment environment(image, {});
  constexpr uint32_t kDraws = 1u << 18;
  const auto texel_of = [&](const glm::vec3& d) {
    const int column =
        static_cast<int>((std::atan2(d.x, -d.z) / (2.0f * kPiF) + 0.5f) * image.width);
    const int row = static_cast<int>((0.5f - std::asin(d.y) / kPiF) * image.height);
    return static_cast<size_t>(std::min(row, image.height - 1) * image.width +
                               std::min(column, image.width - 1));
  };
  std::vector<double> drawn(image.pixels.size(), 0.0);
  for (uint32_t i = 0; i < kDraws; ++i) {
    drawn[texel_of(environment.Draw(SobolPoint(i, 0, 0)).direction)] += 1.0 / kDraws;
  }
  size_t texel = 0;
  OverTheSphere(image.width, [&](const glm::vec3& direction, float solid_angle) {
    const double expected = static_cast<double>(environment.Density(direction)) * solid_angle;
    EXPECT_NEAR(drawn[texel], expected, 0.02 * expected + 1e-4) << texel;
    ++texel;
  });
}

TEST(Environment, DrawsEstimateIntegrals) {
  const Environment environment(MakeUnevenProbe(), {kTurned, 1.5f});
  const glm::vec3 normal = glm::normalize(glm::vec3(0.3f, 1.0f, 0.2f));
  glm::vec3 exact(0.0f);
  OverTheSphere(512, [&](const glm::vec3& direction, float solid_angle) {
    exact += environment.Radiance(direction) *
             (std::max(glm::dot(direction, normal), 0.0f) * solid_angle);
  });
  constexpr int kSide = 256;
  glm::vec3 sum(0.0f);
  for (int i = 0; i < kSide * kSide; ++i) {
    const Environment::Sample sample = environment.Draw(GridPoint(i, kSide));
    sum += environment.Radiance(sample.direction) *
           (std::max(glm::dot(sample.direction, normal), 0.0f) / sample.density /
            static_cast<float>(kSide * kSide));
  }
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(sum[c], exact[c], 0.01f * exact[c]) << c;
  }
}

TEST(Environment, ABlackProbeIsDrawnFromWithoutHarm) {
  const Environment environment(MakeUniformProbe(0.0f), {});
  for (int i = 0; i < 64; ++i) {
    const Environment::Sample sample = environment.Draw(GridPoint(i, 8));
    EXPECT_TRUE(std::isfinite(sample.density));
    EXPECT_NEAR(glm::length(sample.direction), 1.0f, 1e-4f);
    EXPECT_EQ(environment.Radiance(sample.direction), glm::vec3(0.0f));
  }
}

}  // namespace
}  // namespace lararium::bake
