#include "editor/bake/path_tracer.h"

#include <gtest/gtest.h>

#include <cmath>

#include "shared/core/parallel.h"
#include "tests/bake/test_surfaces.h"

namespace lararium::bake {
namespace {

// A view from an eye towards a target; the focal length is in units of the width.
struct View {
  geometry::CameraModel pinhole;
  geometry::Rigid3 camera_from_stage;
};

View MakeView(const Eigen::Vector3d& eye,
              const Eigen::Vector3d& target,
              double focal,
              int width = 12) {
  const Eigen::Vector3d z = (target - eye).normalized();
  const Eigen::Vector3d up =
      std::abs(z.y()) < 0.9 ? Eigen::Vector3d::UnitY() : Eigen::Vector3d::UnitX();
  const Eigen::Vector3d x = z.cross(up).normalized();
  Eigen::Matrix3d rotation;
  rotation << x.transpose(), z.cross(x).transpose(), z.transpose();
  View view;
  view.pinhole.width = view.pinhole.height = width;
  view.pinhole.fx = view.pinhole.fy = focal * width;
  view.pinhole.cx = view.pinhole.cy = 0.5 * (width - 1);
  view.camera_from_stage = geometry::Rigid3::FromMatrix(rotation, -(rotation * eye));
  return view;
}

RadianceImage Trace(std::span<const SurfaceMesh> meshes,
                    const Environment& environment,
                    const View& view,
                    const PathTracing& tracing) {
  NoProgress progress;
  auto image =
      TracePaths(meshes, environment, view.pinhole, view.camera_from_stage, tracing, progress);
  EXPECT_TRUE(image.ok()) << image.message();
  return image.ok() ? *std::move(image) : RadianceImage{};
}

glm::vec4 Mean(const RadianceImage& image) {
  glm::vec4 sum(0.0f);
  for (const glm::vec4& pixel : image.pixels) {
    sum += pixel;
  }
  return sum / static_cast<float>(std::max<size_t>(image.pixels.size(), 1));
}

// Radiance of a white surface, which is irradiance / pi.
glm::vec3 QuadratureRadiance(const Environment& environment, const glm::vec3& normal) {
  constexpr int kWidth = 1024;
  glm::dvec3 sum(0.0);
  for (int row = 0; row < kWidth / 2; ++row) {
    const float e = kPiF * (0.5f - (static_cast<float>(row) + 0.5f) / (kWidth / 2));
    const float solid_angle = std::cos(e) * (2.0f * kPiF / kWidth) * (2.0f * kPiF / kWidth);
    for (int column = 0; column < kWidth; ++column) {
      const float a = 2.0f * kPiF * (static_cast<float>(column) + 0.5f) / kWidth;
      const glm::vec3 d(std::cos(e) * std::sin(a), std::sin(e), -std::cos(e) * std::cos(a));
      sum +=
          glm::dvec3(environment.Radiance(d) * (std::max(glm::dot(d, normal), 0.0f) * solid_angle));
    }
  }
  return glm::vec3(sum / static_cast<double>(kPiF));
}

TEST(PathTracer, AConvexThingInAWhiteFurnaceShowsItsAlbedo) {
  const glm::vec3 albedo(0.8f, 0.4f, 0.1f);
  const SurfaceMesh sphere = MakeSphere(glm::vec3(0.0f), 1.0f, albedo);
  const Environment environment(MakeUniformProbe(2.0f), {});
  const RadianceImage image =
      Trace({&sphere, 1}, environment, MakeView({0, 0.3, 4}, {0, 0, 0}, 1.6, 24), {.samples = 64});
  glm::vec3 radiance(0.0f);
  float coverage = 0.0f;
  for (const glm::vec4& pixel : image.pixels) {
    ASSERT_GE(pixel.a, 0.0f);
    ASSERT_LE(pixel.a, 1.0f);
    radiance += glm::vec3(pixel);
    coverage += pixel.a;
    EXPECT_NEAR(pixel.r, 2.0f * albedo.r * pixel.a, 0.25f);
  }
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(radiance[c] / coverage, 2.0f * albedo[c], 0.01f * 2.0f * albedo[c]);
  }
  // A sphere of radius 1 seen from distance d fills a circle of radius focal / sqrt(d^2 - 1),
  // apart from a small error off the centre.
  const double focal = 1.6 * 24;
  const double disc = std::numbers::pi * focal * focal / (4.0 * 4.0 + 0.3 * 0.3 - 1.0);
  EXPECT_NEAR(coverage, disc, 0.02 * disc);
}

// A point inside half a sphere sends half of its light outside, independent of its position (an
// integrating sphere): radiance = a / 2 sum (a / 2)^k over the bounces k.
TEST(PathTracer, ABowlReflectsIntoItselfAsAnIntegratingSphereDoes) {
  const Environment environment(MakeUniformProbe(1.0f), {});
  for (const float albedo : {0.5f, 1.0f}) {
    const SurfaceMesh bowl =
        MakeCap(glm::vec3(0.0f), 1.0f, 0.5f * kPiF, true, glm::vec3(albedo), 32, 64);
    for (const int bounces : {0, 1, 3, 12}) {
      float expected = 0.0f;
      for (int k = 0; k <= bounces; ++k) {
        expected += std::pow(0.5f * albedo, static_cast<float>(k + 1));
      }
      const RadianceImage image =
          Trace({&bowl, 1}, environment, MakeView({0, 3, 0}, {0, -1, 0}, 3.0),
                {.samples = 256, .bounces = bounces});
      const glm::vec4 mean = Mean(image);
      EXPECT_NEAR(mean.a, 1.0f, 1e-6f);
      EXPECT_NEAR(mean.g, expected, 0.01f) << albedo << ", " << bounces << " bounces";
    }
  }
}

TEST(PathTracer, HalfASkyLightsByHowMuchOfItASurfaceSees) {
  const Environment environment(
      MakeProbe(256, [](const glm::vec3& d) { return glm::vec3(d.y > 0.0f ? 1.0f : 0.0f); }), {});
  const auto radiance = [&](const glm::vec3& normal) {
    const SurfaceMesh disc = MakeDisc(glm::vec3(0.0f), normal, 1.0f, glm::vec3(0.6f));
    const Eigen::Vector3d eye(2.0 * normal.x, 2.0 * normal.y, 2.0 * normal.z);
    return Mean(Trace({&disc, 1}, environment, MakeView(eye, {0, 0, 0}, 4.0), {.samples = 256})).g;
  };
  EXPECT_NEAR(radiance({0, 1, 0}), 0.6f, 0.006f);
  EXPECT_NEAR(radiance({1, 0, 0}), 0.3f, 0.006f);
  EXPECT_NEAR(radiance({0, -1, 0}), 0.0f, 0.002f);
  // The visible share of the sky is (1 + cos tilt) / 2.
  EXPECT_NEAR(radiance({std::sin(0.8f), std::cos(0.8f), 0}), 0.3f * (1.0f + std::cos(0.8f)),
              0.006f);
}

// The form factor from a point to a parallel disc above it: r^2 / (r^2 + h^2).
TEST(PathTracer, ABlackParallelDiscHidesItsFormFactor) {
  const Environment environment(MakeUniformProbe(1.0f), {});
  for (const float height : {0.5f, 1.0f, 2.0f}) {
    const SurfaceMesh meshes[] = {
        MakeDisc({0, 0, 0}, {0, 1, 0}, 3.0f, glm::vec3(0.5f)),
        MakeDisc({0, height, 0}, {0, -1, 0}, 1.0f, glm::vec3(0.0f)),
    };
    const float seen = 1.0f - 1.0f / (1.0f + height * height);
    const View view = MakeView({0, 0.4, 0}, {0, 0, 0}, 40.0);
    const glm::vec4 mean = Mean(Trace(meshes, environment, view, {.samples = 256}));
    EXPECT_NEAR(mean.g, 0.5f * seen, 0.005f) << height;
  }
}

TEST(PathTracer, ASmallSunLightsAsItsIntegralSays) {
  const Environment environment(
      MakeProbe(64,
                [](const glm::vec3& d) {
                  const bool sun = d.x > 0.6f && d.y > 0.6f && std::abs(d.z) < 0.1f;
                  return glm::vec3(0.3f, 0.4f, 0.5f) + (sun ? 2000.0f : 0.0f);
                }),
      {});
  for (const glm::vec3& normal : {glm::vec3(0, 1, 0), glm::vec3(1, 0, 0), glm::vec3(0, 0, 1),
                                  glm::normalize(glm::vec3(-0.4f, 1.0f, 0.3f))}) {
    const SurfaceMesh disc = MakeDisc(glm::vec3(0.0f), normal, 1.0f, glm::vec3(1.0f));
    const Eigen::Vector3d eye(2.0 * normal.x, 2.0 * normal.y, 2.0 * normal.z);
    const glm::vec4 mean =
        Mean(Trace({&disc, 1}, environment, MakeView(eye, {0, 0, 0}, 4.0), {.samples = 256}));
    const glm::vec3 expected = QuadratureRadiance(environment, normal);
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(mean[c], expected[c], 0.015f * expected[c]) << c << " " << normal.x;
    }
  }
}

TEST(PathTracer, ImagesAreUprightAndNotMirrored) {
  // Red is on the right and green above, seen from +Z.
  const SurfaceMesh meshes[] = {
      MakeDisc({0.6f, 0, 0}, {0, 0, 1}, 0.3f, {1, 0, 0}),
      MakeDisc({0, 0.6f, 0}, {0, 0, 1}, 0.3f, {0, 1, 0}),
  };
  const Environment environment(MakeUniformProbe(1.0f), {});
  const RadianceImage image =
      Trace(meshes, environment, MakeView({0, 0, 2}, {0, 0, 0}, 1.0, 15), {.samples = 16});
  const auto pixel = [&](int column, int row) {
    return image.pixels[static_cast<size_t>(row * image.width + column)];
  };
  EXPECT_GT(pixel(11, 7).r, 0.5f);
  EXPECT_LT(pixel(11, 7).g, 0.01f);
  EXPECT_GT(pixel(7, 3).g, 0.5f);
  EXPECT_EQ(pixel(3, 7), glm::vec4(0.0f));
  EXPECT_EQ(pixel(7, 11), glm::vec4(0.0f));
}

TEST(PathTracer, TheSameSeedGivesTheSameImageOnAnyNumberOfCores) {
  const SurfaceMesh meshes[] = {
      MakeCap(glm::vec3(0.0f), 1.0f, 0.5f * kPiF, true, glm::vec3(0.7f)),
      MakeSphere({0.1f, -0.4f, 0.0f}, 0.3f, glm::vec3(0.5f)),
  };
  const Environment environment(
      MakeProbe(32, [](const glm::vec3& d) { return glm::vec3(1.5f + d.x, 1.0f, 1.5f + d.z); }),
      {});
  const View view = MakeView({0, 3, 0.5}, {0, -0.4, 0}, 1.5, 40);
  const RadianceImage many = Trace(meshes, environment, view, {.samples = 8, .seed = 5});
  const RadianceImage other = Trace(meshes, environment, view, {.samples = 8, .seed = 6});
  const ThreadLimit limit(1);
  const RadianceImage one = Trace(meshes, environment, view, {.samples = 8, .seed = 5});
  EXPECT_EQ(many.pixels, one.pixels);
  EXPECT_NE(many.pixels, other.pixels);
}

TEST(PathTracer, KeepsRealSurfacesApartAndLetsThemTakePartInTheLight) {
  // A disc under a black one: it is visible around the black one, and darker than alone.
  const SurfaceMesh meshes[] = {
      MakeDisc({0, 0.5f, 0}, {0, 1, 0}, 0.4f, glm::vec3(0.0f)),
      MakeDisc({0, 0, 0}, {0, 1, 0}, 3.0f, glm::vec3(0.5f)),
  };
  const Environment environment(MakeUniformProbe(1.0f), {});
  const View view = MakeView({0, 4, 0}, {0, 0, 0}, 2.0);
  const RadianceImage image = Trace(meshes, environment, view, {.samples = 64, .first_real = 1});
  ASSERT_EQ(image.real.size(), image.pixels.size());
  float both = 0.0f;
  for (size_t i = 0; i < image.pixels.size(); ++i) {
    EXPECT_NEAR(image.pixels[i].a + image.real[i].a, 1.0f, 1e-5f);
    EXPECT_EQ(glm::vec3(image.pixels[i]), glm::vec3(0.0f));
    both = std::max(both, std::min(image.pixels[i].a, image.real[i].a));
  }
  EXPECT_GT(both, 0.1f);
  // The corner of the picture is about a metre from the point below the middle of the disc.
  const glm::vec4 corner = image.real[0];
  EXPECT_LT(corner.g, 0.5f);
  EXPECT_GT(corner.g, 0.4f);
  const RadianceImage all = Trace(meshes, environment, view, {.samples = 4});
  EXPECT_TRUE(all.real.empty());
}

TEST(PathTracer, WhatGivesOffLightIsSeenWithItAndLightsOthers) {
  SurfaceMesh meshes[] = {
      MakeDisc({0, 0, 0}, {0, 1, 0}, 3.0f, glm::vec3(0.5f)),
      MakeDisc({0, 1, 0}, {0, -1, 0}, 1.0f, glm::vec3(0.0f)),
  };
  meshes[1].emission = {4.0f, 2.0f, 0.0f};
  const Environment environment(MakeUniformProbe(0.0f), {});
  const View below = MakeView({0, 0.4, 0}, {0, 0, 0}, 40.0);
  const glm::vec4 lit = Mean(Trace(meshes, environment, below, {.samples = 1024}));
  EXPECT_NEAR(lit.r, 0.5f * 0.5f * 4.0f, 0.03f);  // The form factor is a half.
  EXPECT_NEAR(lit.g, 0.5f * 0.5f * 2.0f, 0.02f);
  const View up = MakeView({0, 0.2, 0}, {0, 1, 0}, 4.0);
  EXPECT_NEAR(Mean(Trace(meshes, environment, up, {.samples = 4})).r, 4.0f, 1e-4f);
}

class Impatient : public Progress {
 public:
  void Report(std::string_view, double) override {}
  bool Cancelled() const override { return true; }
};

TEST(PathTracer, EndsWhenCancelledAndRefusesNothingToSee) {
  const SurfaceMesh sphere = MakeSphere(glm::vec3(0.0f), 1.0f, glm::vec3(0.5f));
  const Environment environment(MakeUniformProbe(1.0f), {});
  const View view = MakeView({0, 0, 4}, {0, 0, 0}, 1.0);
  Impatient impatient;
  EXPECT_FALSE(
      TracePaths({&sphere, 1}, environment, view.pinhole, view.camera_from_stage, {}, impatient)
          .ok());
  NoProgress progress;
  EXPECT_FALSE(
      TracePaths({}, environment, view.pinhole, view.camera_from_stage, {}, progress).ok());
}

}  // namespace
}  // namespace lararium::bake
