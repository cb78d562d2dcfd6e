#include "editor/bake/ray_scene.h"

#include <gtest/gtest.h>

#include "tests/bake/test_surfaces.h"

namespace lararium::bake {
namespace {

RayScene MakeScene(std::span<const SurfaceMesh> meshes) {
  std::vector<RayMesh> ray_meshes;
  for (const SurfaceMesh& mesh : meshes) {
    ray_meshes.push_back(mesh.ray_mesh());
  }
  auto scene = RayScene::Create(ray_meshes);
  CHECK(scene.ok());
  return *std::move(scene);
}

// The square from (0, 0) to (1, 1) at a height, facing up, with texture coordinates.
SurfaceMesh MakeSquare(float height) {
  SurfaceMesh mesh;
  for (const glm::vec2& at : {glm::vec2(0, 0), glm::vec2(1, 0), glm::vec2(1, 1), glm::vec2(0, 1)}) {
    AddVertex({at.x, height, at.y}, {0, 1, 0}, glm::vec3(0.5f), mesh);
    mesh.uvs.push_back(at);
  }
  AddTriangle(0, 1, 2, {0, 1, 0}, mesh);
  AddTriangle(0, 2, 3, {0, 1, 0}, mesh);
  return mesh;
}

TEST(RayScene, AHitNamesItsMeshTriangleDistanceAndCorners) {
  SurfaceMesh nothing;
  const SurfaceMesh meshes[] = {nothing, MakeSquare(0.0f), MakeSquare(-1.0f)};
  const RayScene scene = MakeScene(meshes);
  const glm::vec3 target(0.8f, 0.0f, 0.3f);
  const glm::vec3 origin(0.2f, 2.0f, -1.0f);
  const glm::vec3 direction = glm::normalize(target - origin);
  const auto hit = scene.Trace(origin, direction);
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->mesh, 1u);
  EXPECT_NEAR(hit->distance, glm::distance(origin, target), 1e-5f);
  glm::vec3 at(0.0f);
  for (int c = 0; c < 3; ++c) {
    at += hit->barycentric[c] * meshes[1].positions[meshes[1].indices[3 * hit->triangle + c]];
  }
  EXPECT_LT(glm::distance(at, target), 1e-5f);
  EXPECT_LT(glm::distance(hit->face, glm::vec3(0, 1, 0)), 1e-6f);
  // Beyond the first surface, the ray hits the second.
  const auto next = scene.Trace({0.5f, 2.0f, 0.5f}, {0, -1, 0}, 2.5f);
  ASSERT_TRUE(next);
  EXPECT_EQ(next->mesh, 2u);
}

TEST(RayScene, TheFaceIsThatOfTheTriangleFromEitherSide) {
  const SurfaceMesh square = MakeSquare(0.0f);
  const RayScene scene = MakeScene({&square, 1});
  const auto hit = scene.Trace({0.5f, -1.0f, 0.4f}, {0, 1, 0});
  ASSERT_TRUE(hit);
  EXPECT_LT(glm::distance(hit->face, glm::vec3(0, 1, 0)), 1e-6f);
}

TEST(RayScene, BlockedAgreesWithTrace) {
  const SurfaceMesh meshes[] = {MakeSphere({0, 0, 0}, 1.0f, glm::vec3(0.5f)),
                                MakeBox({1.2f, -1, -1}, {2, 1, 1}, glm::vec3(0.5f))};
  const RayScene scene = MakeScene(meshes);
  int hits = 0;
  for (int i = 0; i < 1000; ++i) {
    const float angle = 0.1f * static_cast<float>(i);
    const glm::vec3 origin(3.0f * std::cos(angle), 2.0f * std::sin(0.37f * angle),
                           3.0f * std::sin(angle));
    const glm::vec3 direction = glm::normalize(
        glm::vec3(std::sin(1.7f * angle), std::cos(2.3f * angle), -0.2f) - 0.5f * origin);
    const bool hit = scene.Trace(origin, direction).has_value();
    EXPECT_EQ(hit, scene.Blocked(origin, direction)) << i;
    hits += hit;
  }
  EXPECT_GT(hits, 100);
  EXPECT_LT(hits, 900);
}

TEST(RayScene, RaysPassWhereATextureCoversNothing) {
  SurfaceMesh upper = MakeSquare(0.0f);
  // The left half is open, the right half solid; texture coordinates wrap.
  upper.coverage = (cv::Mat_<uint8_t>(1, 2) << 0, 255);
  for (glm::vec2& uv : upper.uvs) {
    uv += glm::vec2(-2.0f, 3.0f);
  }
  const SurfaceMesh meshes[] = {upper, MakeSquare(-1.0f)};
  const RayScene scene = MakeScene(meshes);
  EXPECT_EQ(scene.Trace({0.25f, 1, 0.5f}, {0, -1, 0})->mesh, 1u);
  EXPECT_EQ(scene.Trace({0.75f, 1, 0.5f}, {0, -1, 0})->mesh, 0u);
  const RayScene alone = MakeScene({&upper, 1});
  EXPECT_FALSE(alone.Blocked({0.25f, 1, 0.5f}, {0, -1, 0}));
  EXPECT_TRUE(alone.Blocked({0.75f, 1, 0.5f}, {0, -1, 0}));
}

TEST(RayScene, RefusesToBeEmpty) {
  EXPECT_FALSE(RayScene::Create({}).ok());
  const RayMesh nothing;
  EXPECT_FALSE(RayScene::Create({&nothing, 1}).ok());
}

}  // namespace
}  // namespace lararium::bake
