#include "editor/import/cast/implicit_surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "tests/import/closed_surface.h"

namespace lararium::import {
namespace {

const DistanceField kBall = [](const glm::vec3& p) { return glm::length(p) - 0.5f; };

TEST(Polygonise, OfABallLiesOnTheBall) {
  const geometry::TriangleMesh mesh = Polygonise(kBall, {glm::vec3(-0.6f), glm::vec3(0.6f)}, 0.05f);
  ASSERT_TRUE(mesh.Validate("ball").ok());
  for (size_t v = 0; v < mesh.positions.size(); ++v) {
    EXPECT_NEAR(glm::length(mesh.positions[v]), 0.5f, 1e-4f);
    EXPECT_LT(glm::distance(mesh.normals[v], glm::normalize(mesh.positions[v])), 1e-2f);
  }
}

TEST(Polygonise, GivesAClosedSurfaceThatFacesOutwards) {
  const geometry::TriangleMesh mesh = Polygonise(kBall, {glm::vec3(-0.6f), glm::vec3(0.6f)}, 0.05f);
  EXPECT_EQ(CountOpenEdges(mesh.indices), 0u);
  double volume = 0.0;
  for (size_t i = 0; i < mesh.indices.size(); i += 3) {
    const glm::dvec3 a(mesh.positions[mesh.indices[i]]), b(mesh.positions[mesh.indices[i + 1]]),
        c(mesh.positions[mesh.indices[i + 2]]);
    volume += glm::dot(a, glm::cross(b, c)) / 6.0;
  }
  EXPECT_NEAR(volume, 4.0 / 3.0 * std::numbers::pi * 0.125, 0.01);
}

TEST(SmoothUnion, IsTheMinimumAwayFromTheFillet) {
  EXPECT_FLOAT_EQ(SmoothUnion(0.1f, 0.5f, 0.2f), 0.1f);
  EXPECT_LT(SmoothUnion(0.1f, 0.12f, 0.2f), 0.1f);
  EXPECT_FLOAT_EQ(SmoothIntersection(0.1f, 0.5f, 0.2f), 0.5f);
}

TEST(RoundCone, IsASphereBeyondEachEnd) {
  const glm::vec3 a(0.0f), b(0.0f, 1.0f, 0.0f);
  EXPECT_NEAR(RoundCone({0.0f, -0.5f, 0.0f}, a, 0.2f, b, 0.1f), 0.3f, 1e-6f);
  EXPECT_NEAR(RoundCone({0.0f, 2.0f, 0.0f}, a, 0.2f, b, 0.1f), 0.9f, 1e-6f);
  EXPECT_NEAR(RoundCone({0.5f, 0.5f, 0.0f}, a, 0.2f, b, 0.1f), 0.35f, 1e-6f);
}

TEST(Ellipsoid, VanishesOnItsSurface) {
  const glm::vec3 center(1.0f, 2.0f, 3.0f), radii(0.1f, 0.2f, 0.3f);
  EXPECT_NEAR(Ellipsoid(center + glm::vec3(0.1f, 0.0f, 0.0f), center, radii), 0.0f, 1e-6f);
  EXPECT_NEAR(Ellipsoid(center + glm::vec3(0.0f, 0.0f, -0.3f), center, radii), 0.0f, 1e-6f);
  EXPECT_LT(Ellipsoid(center, center, radii), -0.09f);
}

TEST(Loft, PassesThroughItsStations) {
  const Loft loft({0, 0, 0}, glm::mat3(1.0f),
                  {{0.0f, {0.0f, 0.0f}, {0.1f, 0.2f}},
                   {0.5f, {0.05f, 0.0f}, {0.2f, 0.3f}},
                   {1.0f, {0.0f, 0.0f}, {0.1f, 0.1f}}});
  EXPECT_NEAR(loft.SideDistance({0.25f, 0.5f, 0.0f}), 0.0f, 1e-6f);
  EXPECT_NEAR(loft.SideDistance({0.05f, 0.5f, 0.3f}), 0.0f, 1e-6f);
  EXPECT_NEAR(loft.SideDistance({0.0f, 0.0f, -0.2f}), 0.0f, 1e-6f);
  EXPECT_NEAR(loft.Distance({0.0f, 1.5f, 0.0f}, 0.01f), 0.5f, 1e-6f);
}

}  // namespace
}  // namespace lararium::import
