#include "shared/light/lamp.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <memory>

#include "shared/core/units.h"
#include "shared/light/probe_light.h"
#include "shared/light/quadrature.h"
#include "tests/light/sh_test_support.h"

namespace lararium::light {
namespace {

// Radiance at receivers, unshadowed unless the test adds shadows.
struct Receivers {
  Receivers(const std::vector<glm::vec3>& positions, int count)
      : points(positions),
        own_log(count, positions.size()),
        radiance{own_log, own_log, own_log},
        range{0, positions.size()} {}

  void Light(const Lamp& lamp, const std::vector<Ball>& blockers = {}) {
    const BallArrays balls(blockers);
    AddLamps({&lamp, 1}, points.points(), own_log, balls.spheres(), range, radiance);
  }
  ShRgb At(size_t receiver) const {
    ShRgb light = {};
    for (int k = 0; k < own_log.count(); ++k) {
      for (int channel = 0; channel < 3; ++channel) {
        light[k][channel] = radiance[static_cast<size_t>(channel)].at(k, receiver);
      }
    }
    return light;
  }

  PointArrays points;
  ShRows own_log;
  ShRowsRgb radiance;
  ReceiverRange range;
};

const Lamp kLamp = {{1.0f, 0.5f, -2.0f}, {3.0f, 2.0f, 1.0f}, 0.2f};

std::vector<glm::vec3> Around(const Lamp& lamp, Random& random, int count) {
  std::vector<glm::vec3> points;
  for (int i = 0; i < count; ++i) {
    const auto distance = static_cast<float>(random.Uniform(1.5 * lamp.radius, 4.0));
    points.push_back(lamp.position + distance * RandomDirection(random));
  }
  return points;
}

TEST(Lamp, FacingItsIrradianceIsThatOfABallOfEvenRadiance) {
  // Over the cone of the ball: L cos integrated gives pi L sin^2 of its angular radius.
  const double radiance = kLamp.intensity.r / (kPi * kLamp.radius * kLamp.radius);
  for (const float distance : {0.25f, 0.5f, 1.0f, 4.0f}) {
    const Sun seen = SeenFrom(kLamp, kLamp.position + glm::vec3(0.0f, 0.0f, distance));
    double irradiance = 0.0;
    for (const SphereNode& node : SphereQuadrature(8, std::cos(seen.angular_radius), 1.0)) {
      irradiance += node.weight * radiance * node.direction.z;
    }
    EXPECT_NEAR(seen.irradiance.r / irradiance, 1.0, 5e-5) << distance;
    EXPECT_LT(glm::distance(seen.direction, glm::vec3(0, 0, -1)), 1e-6f);
  }
}

TEST(Lamp, TheLightOfReceiversIsTheDiscThatTheySee) {
  Random random(1);
  for (const int count : {9, 16, 25}) {
    const std::vector<glm::vec3> points = Around(kLamp, random, 20);
    Receivers receivers(points, count);
    receivers.Light(kLamp);
    for (size_t i = 0; i < points.size(); ++i) {
      const Sun seen = SeenFrom(kLamp, points[i]);
      const ShRgb expected = ProjectSun(seen);
      for (int k = 0; k < count; ++k) {
        EXPECT_LT(glm::distance(receivers.At(i)[k], expected[k]),
                  1e-4f * (seen.irradiance.r + 1.0f))
            << "seed 1, count " << count << ", point " << i << ", " << k;
      }
    }
  }
}

TEST(Lamp, IrradianceOfTiltedSurfacesFollowsTheCosine) {
  // The error of the cosine's harmonics up to degree 3 is at most 0.094, at its edge.
  Receivers receivers({kLamp.position + glm::vec3(0.0f, 2.0f, 0.0f)}, 16);
  receivers.Light(kLamp);
  const Sun seen = SeenFrom(kLamp, kLamp.position + glm::vec3(0.0f, 2.0f, 0.0f));
  Random random(2);
  for (int i = 0; i < 50; ++i) {
    const glm::vec3 normal = RandomDirection(random);
    const float expected = seen.irradiance.g * std::max(0.0f, glm::dot(normal, seen.direction));
    EXPECT_NEAR(EvaluateIrradiance(receivers.At(0), normal).g, expected, 0.1f * seen.irradiance.g)
        << "seed 2, normal " << i;
  }
}

TEST(Lamp, SeveralAddUp) {
  const Lamp other = {{-1.0f, 2.0f, 0.5f}, {0.5f, 1.0f, 2.0f}, 0.05f};
  const std::vector<glm::vec3> points = {{0, 0, 0}, {1, 1, 1}};
  Receivers both(points, 16), first(points, 16), second(points, 16);
  both.Light(kLamp);
  both.Light(other);
  first.Light(kLamp);
  second.Light(other);
  for (int k = 0; k < 16; ++k) {
    EXPECT_LT(glm::distance(both.At(1)[k], first.At(1)[k] + second.At(1)[k]), 1e-5f);
  }
}

TEST(Lamp, ABallBetweenHidesItAndOneBehindDoesNot) {
  const glm::vec3 point = kLamp.position + glm::vec3(0.0f, 0.0f, 2.0f);
  const auto share = [&](const Ball& ball) {
    Receivers lit({point}, 16), shaded({point}, 16);
    lit.Light(kLamp);
    shaded.Light(kLamp, {ball});
    return shaded.At(0)[0].r / lit.At(0)[0].r;
  };
  const glm::vec3 middle = kLamp.position + glm::vec3(0.0f, 0.0f, 1.0f);
  EXPECT_NEAR(share({middle, 0.2f}), 0.0f, 1e-5f);
  // At the ball's distance the lamp's disc has a radius of 0.1 m: a ball of half that radius hides
  // a quarter.
  EXPECT_NEAR(share({middle, 0.05f}), 0.75f, 1e-3f);
  EXPECT_EQ(share({middle + glm::vec3(0.5f, 0.0f, 0.0f), 0.2f}), 1.0f);
  EXPECT_EQ(share({kLamp.position - glm::vec3(0.0f, 0.0f, 0.6f), 0.3f}), 1.0f);
  EXPECT_EQ(share({point + glm::vec3(0.0f, 0.0f, 0.3f), 0.2f}), 1.0f);
  // A ball that touches the lamp holds it.
  EXPECT_EQ(share({kLamp.position + glm::vec3(0.0f, 0.0f, 0.3f), 0.25f}), 1.0f);
}

TEST(Lamp, HalfOfItIsHiddenByABallWhoseRimIsAtItsMiddle) {
  const glm::vec3 point = kLamp.position + glm::vec3(0.0f, 0.0f, 2.0f);
  Receivers lit({point}, 16), shaded({point}, 16);
  lit.Light(kLamp);
  shaded.Light(kLamp, {{kLamp.position + glm::vec3(0.6f, 0.0f, 1.0f), 0.6f}});
  EXPECT_NEAR(shaded.At(0)[0].r / lit.At(0)[0].r, 0.5f, 0.02f);
}

// A wall half a metre beyond the lamp, in the lamp's map: x = 1.5.
std::shared_ptr<const LampWalls> WallBeside(const Lamp& lamp) {
  auto walls = std::make_shared<LampWalls>();
  for (int row = 0; row < LampWalls::kSize; ++row) {
    for (int column = 0; column < LampWalls::kSize; ++column) {
      if (LampWalls::Direction(column, row).x > 1e-4f) {
        walls->planes[static_cast<size_t>(row * LampWalls::kSize + column)] =
            glm::vec4(1.0f, 0.0f, 0.0f, lamp.position.x + 0.5f);
      }
    }
  }
  return walls;
}

TEST(LampWalls, KeepLightFromWhatIsBehindThemAndFromNothingElse) {
  Lamp walled = kLamp;
  walled.walls = WallBeside(kLamp);
  Random random(5);
  const std::vector<glm::vec3> points = Around(kLamp, random, 400);
  Receivers open(points, 16), beside(points, 16);
  open.Light(kLamp);
  beside.Light(walled);
  int behind = 0;
  for (size_t i = 0; i < points.size(); ++i) {
    const bool hidden = points[i].x > kLamp.position.x + 0.5f + LampWalls::kOnWall;
    behind += hidden ? 1 : 0;
    EXPECT_EQ(beside.At(i)[0].r, hidden ? 0.0f : open.At(i)[0].r) << "seed 5, point " << i;
  }
  EXPECT_GT(behind, 50);
}

// Tests all angles of the light, also grazing ones.
TEST(LampWalls, DoNotShadeThemselves) {
  const auto walls = WallBeside(kLamp);
  for (float away = 0.0f; away < 20.0f; away += 0.37f) {
    const glm::vec3 on = kLamp.position + glm::vec3(0.5f, 0.3f * away, away);
    EXPECT_EQ(PastWalls(*walls, kLamp.position, on), 1.0f) << away;
    EXPECT_EQ(PastWalls(*walls, kLamp.position, on + glm::vec3(0.1f, 0.0f, 0.0f)), 0.0f) << away;
  }
  EXPECT_EQ(PastWalls(*walls, kLamp.position, kLamp.position), 1.0f);
}

TEST(Lamp, OwnVisibilityDimsIt) {
  Receivers receivers({{0, 0, 0}}, 16);
  const float y00 = EvaluateShBasis(glm::vec3(0, 0, 1))[0];
  receivers.own_log.at(0, 0) = std::log(0.25f) / y00;  // a quarter in all directions
  Receivers open({{0, 0, 0}}, 16);
  receivers.Light(kLamp);
  open.Light(kLamp);
  EXPECT_NEAR(receivers.At(0)[0].g / open.At(0)[0].g, 0.25f, 1e-4f);
}

TEST(Lamp, WithinItIsNoBrighterThanAtItsSurface) {
  const glm::vec3 surface = kLamp.position + glm::vec3(kNearestLamp * kLamp.radius, 0, 0);
  const float most = SeenFrom(kLamp, surface).irradiance.r;
  EXPECT_LE(SeenFrom(kLamp, kLamp.position).irradiance.r, most);
  Receivers receivers({kLamp.position, surface}, 16);
  receivers.Light(kLamp);
  for (size_t i = 0; i < 2; ++i) {
    for (const glm::vec3& c : receivers.At(i)) {
      EXPECT_TRUE(std::isfinite(c.r));
    }
  }
}

TEST(Lamp, ReachIsWhereItsLightIsThatLow) {
  const float reach = ReachOf(kLamp, 0.03f);
  EXPECT_NEAR(SeenFrom(kLamp, kLamp.position + glm::vec3(reach, 0, 0)).irradiance.r, 0.03f, 1e-5f);
}

TEST(Flicker, IsSmoothSeededAndAboutOne) {
  double sum = 0.0;
  float before = Flicker(7, 0.0, 0.4f);
  for (int tick = 1; tick <= 120 * 60; ++tick) {
    const double time = tick / 120.0;
    const float now = Flicker(7, time, 0.4f);
    EXPECT_GE(now, 0.6f);
    EXPECT_LE(now, 1.4f);
    EXPECT_LT(std::abs(now - before), 0.06f) << time;
    sum += before = now;
  }
  EXPECT_NEAR(sum / (120 * 60), 1.0, 0.05);
  EXPECT_EQ(Flicker(7, 12.34, 0.4f), Flicker(7, 12.34, 0.4f));
  EXPECT_NE(Flicker(7, 12.34, 0.4f), Flicker(8, 12.34, 0.4f));
  EXPECT_EQ(Flicker(7, 12.34, 0.0f), 1.0f);
}

TEST(ColourOfTemperature, IsWhiteForDaylightAndRedderForEmbers) {
  const glm::vec3 daylight = ColourOfTemperature(6504.0);
  EXPECT_LT(glm::distance(daylight, glm::vec3(1.0f)), 0.08f);
  float before = 1.0f;
  for (const double kelvin : {5000.0, 3000.0, 2000.0, 1700.0}) {
    const glm::vec3 colour = ColourOfTemperature(kelvin);
    EXPECT_NEAR(glm::dot(colour, glm::vec3(0.2126f, 0.7152f, 0.0722f)), 1.0f, 1e-5f);
    EXPECT_GT(colour.r / colour.g, before);
    EXPECT_GE(colour.b, 0.0f);
    before = colour.r / colour.g;
  }
}

}  // namespace
}  // namespace lararium::light
