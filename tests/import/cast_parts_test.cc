#include "editor/import/cast/cast_parts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <opencv2/imgcodecs.hpp>

#include "editor/import/cast/cast_paint.h"
#include "editor/import/model/levels_of_detail.h"
#include "tests/support/png.h"

namespace lararium::import {
namespace {

// A unit sphere of rings; the vertices of its seam are doubled and share a source.
CastPiece Sphere(uint32_t rings, uint32_t columns) {
  CastPiece piece;
  for (uint32_t r = 0; r <= rings; ++r) {
    for (uint32_t c = 0; c <= columns; ++c) {
      const float latitude = std::numbers::pi_v<float> * r / rings;
      const float longitude = 2.0f * std::numbers::pi_v<float> * (c % columns) / columns;
      piece.mesh.positions.emplace_back(std::sin(latitude) * std::cos(longitude),
                                        std::cos(latitude),
                                        std::sin(latitude) * std::sin(longitude));
      const bool pole = r == 0 || r == rings;
      piece.source.push_back(r * (columns + 1) + (pole ? 0 : c % columns));
      piece.mesh.uvs.emplace_back(float(c) / columns, float(r) / rings);
    }
  }
  for (uint32_t r = 0; r < rings; ++r) {
    for (uint32_t c = 0; c < columns; ++c) {
      const uint32_t a = r * (columns + 1) + c;
      const uint32_t b = a + columns + 1;
      if (r > 0) {
        piece.mesh.indices.insert(piece.mesh.indices.end(), {a, a + 1, b});
      }
      if (r + 1 < rings) {
        piece.mesh.indices.insert(piece.mesh.indices.end(), {a + 1, b + 1, b});
      }
    }
  }
  const size_t count = piece.mesh.positions.size();
  piece.base.assign(count, {0, 0, 0});
  piece.base_weights.assign(count, glm::vec3(1, 0, 0));
  piece.mesh.albedo.assign(count, glm::vec3(1.0f));
  piece.mesh.joints.assign(count, {0, 0, 0, 0});
  piece.mesh.weights.assign(count, glm::vec4(1, 0, 0, 0));
  piece.mesh.normals = SmoothNormals(piece.mesh.positions, piece.source, piece.mesh.indices);
  return piece;
}

TEST(SmoothNormals, OfASphereAreItsRadiiAlsoAlongTheSeam) {
  const CastPiece sphere = Sphere(24, 48);
  for (size_t v = 0; v < sphere.mesh.positions.size(); ++v) {
    EXPECT_GT(glm::dot(sphere.mesh.normals[v], sphere.mesh.positions[v]), 0.999f) << v;
  }
  const size_t row = 12 * 49;
  EXPECT_EQ(sphere.mesh.normals[row], sphere.mesh.normals[row + 48]);
}

TEST(RemoveHidden, LeavesWhatHasASeenCorner) {
  CastPiece sphere = Sphere(8, 16);
  std::vector<bool> hidden;
  for (const glm::vec3& p : sphere.mesh.positions) {
    hidden.push_back(p.y < 0.1f);
  }
  const size_t before = sphere.mesh.indices.size();
  RemoveHidden(sphere, hidden);
  EXPECT_LT(sphere.mesh.indices.size(), before);
  EXPECT_GT(sphere.mesh.indices.size(), before / 4);
  EXPECT_TRUE(sphere.mesh.Validate(1, 0, "sphere").ok());
  EXPECT_EQ(sphere.source.size(), sphere.mesh.positions.size());
  for (size_t i = 0; i < sphere.mesh.indices.size(); i += 3) {
    float highest = -1.0f;
    for (int k = 0; k < 3; ++k) {
      highest = std::max(highest, sphere.mesh.positions[sphere.mesh.indices[i + k]].y);
    }
    EXPECT_GE(highest, 0.1f);
  }
}

TEST(LevelsOfDetail, AreCoarserOneAfterTheOtherAndTheirErrorIsTrue) {
  human::SkinnedMesh mesh = Sphere(48, 96).mesh;
  OrderTriangles(mesh);
  AddLevelsOfDetail(mesh);
  ASSERT_GE(mesh.coarser.size(), 4u);
  EXPECT_TRUE(mesh.Validate(1, 0, "sphere").ok());
  size_t triangles = mesh.indices.size();
  float error = 0.0f;
  for (const human::LevelOfDetail& level : mesh.coarser) {
    EXPECT_LT(level.indices.size(), 0.86 * triangles);
    EXPECT_GE(level.error, error);
    triangles = level.indices.size();
    error = level.error;
    // The middle of a chord is inside the sphere by this distance.
    float deepest = 0.0f;
    for (size_t i = 0; i < level.indices.size(); i += 3) {
      const glm::vec3 middle =
          (mesh.positions[level.indices[i]] + mesh.positions[level.indices[i + 1]] +
           mesh.positions[level.indices[i + 2]]) /
          3.0f;
      deepest = std::max(deepest, 1.0f - glm::length(middle));
    }
    EXPECT_LT(deepest, 2.0f * error + 0.005f);
  }
}

TEST(LevelsOfDetail, GoWithoutWhatIsCovered) {
  human::SkinnedMesh mesh = Sphere(48, 96).mesh;
  std::vector<bool> covered;
  for (const glm::vec3& p : mesh.positions) {
    covered.push_back(p.y < 0.1f);
  }
  const std::vector<uint32_t> whole = mesh.indices;
  AddLevelsOfDetail(mesh, covered);
  EXPECT_EQ(mesh.indices, whole);
  ASSERT_FALSE(mesh.coarser.empty());
  for (const human::LevelOfDetail& level : mesh.coarser) {
    float highest = -1.0f;
    for (const uint32_t v : level.indices) {
      // One ring of triangles crosses the border.
      EXPECT_GT(mesh.positions[v].y, 0.0f);
      highest = std::max(highest, mesh.positions[v].y);
    }
    EXPECT_GT(highest, 0.95f);
  }
}

TEST(LevelsOfDetail, OfAThingAreOffByAShareOfTheirEdgesAtLeast) {
  const human::SkinnedMesh sphere = Sphere(48, 96).mesh;
  stage::Prop prop;
  stage::PropMesh& mesh = prop.parts.emplace_back().meshes.emplace_back();
  mesh.positions = sphere.positions;
  // In a flat mesh only the light between vertices has an error.
  for (glm::vec3& p : mesh.positions) {
    p.y = 0.0f;
  }
  mesh.indices = sphere.indices;
  AddLevelsOfDetail(prop);
  ASSERT_FALSE(mesh.coarser.empty());
  float before = 0.0f;
  for (const human::LevelOfDetail& level : mesh.coarser) {
    EXPECT_GE(level.error, 0.01f * MeanEdge(mesh.positions, level.indices));
    EXPECT_GE(level.error, before);
    before = level.error;
  }
}

TEST(LevelsOfDetail, AreNoneWhereAllIsCovered) {
  human::SkinnedMesh mesh = Sphere(48, 96).mesh;
  AddLevelsOfDetail(mesh, std::vector<bool>(mesh.positions.size(), true));
  EXPECT_TRUE(mesh.coarser.empty());
}

TEST(LevelsOfDetail, OfAFewTrianglesAreNone) {
  human::SkinnedMesh mesh = Sphere(3, 4).mesh;
  AddLevelsOfDetail(mesh);
  EXPECT_TRUE(mesh.coarser.empty());
  human::SkinnedMesh empty;
  OrderTriangles(empty);
  AddLevelsOfDetail(empty);
  EXPECT_TRUE(empty.coarser.empty());
}

// The corner positions of a list of triangles, independent of vertex numbers.
std::vector<glm::vec3> Corners(const human::SkinnedMesh& mesh,
                               const std::vector<uint32_t>& indices) {
  std::vector<glm::vec3> corners;
  for (const uint32_t index : indices) {
    corners.push_back(mesh.positions[index]);
    corners.push_back(mesh.normals[index]);
  }
  return corners;
}

TEST(OrderVertices, ChangesNothingButTheNumbersAndPutsCoarseLevelsFirst) {
  human::Human human;
  human.meshes = {Sphere(24, 48).mesh};
  human::SkinnedMesh& mesh = human.meshes[0];
  OrderTriangles(mesh);
  AddLevelsOfDetail(mesh);
  ASSERT_GE(mesh.coarser.size(), 4u);
  const auto count = static_cast<uint32_t>(mesh.positions.size());
  human.morphs = {{"up", {{0, {1, count / 2, count - 1}, {}, {}}}}};
  human::MorphTarget::Part& part = human.morphs[0].parts[0];
  for (const uint32_t vertex : part.vertices) {
    part.position_deltas.push_back(mesh.positions[vertex]);
    part.normal_deltas.push_back(mesh.normals[vertex]);
  }
  human.cloths.resize(1);
  for (uint32_t vertex = 0; vertex < count; ++vertex) {
    human.cloths[0].vertex_triangle.push_back(vertex % 7);
    human.cloths[0].vertex_weights.push_back(mesh.positions[vertex] + glm::vec3(vertex % 7));
  }
  human::LightTransfer& light = human.light;
  light.count = 1;
  light.meshes.resize(1);
  light.meshes[0].receivers.resize(count);
  light.meshes[0].weights.resize(count);
  for (size_t row = 0; row < 2 * count; ++row) {
    light.meshes[0].scale.push_back(mesh.positions[row % count].x + (row < count ? 0.0f : 5.0f));
    for (int channel = 0; channel < 3; ++channel) {
      light.meshes[0].coefficients.push_back(
          static_cast<int8_t>(100.0f * mesh.positions[row % count][channel]));
    }
  }
  const human::Human before = human;
  OrderVertices(human);
  for (size_t row = 0; row < 2 * count; ++row) {
    const glm::vec3& at = mesh.positions[row % count];
    EXPECT_EQ(light.meshes[0].scale[row], at.x + (row < count ? 0.0f : 5.0f));
    for (int channel = 0; channel < 3; ++channel) {
      EXPECT_EQ(light.meshes[0].coefficients[3 * row + static_cast<size_t>(channel)],
                static_cast<int8_t>(100.0f * at[channel]));
    }
  }
  EXPECT_EQ(Corners(mesh, mesh.indices), Corners(before.meshes[0], before.meshes[0].indices));
  std::vector<bool> seen(count, false);
  uint32_t next = 0;
  for (size_t i = mesh.coarser.size(); i-- > 0;) {
    const std::vector<uint32_t>& indices = mesh.coarser[i].indices;
    EXPECT_EQ(Corners(mesh, indices),
              Corners(before.meshes[0], before.meshes[0].coarser[i].indices));
    for (const uint32_t index : indices) {
      seen[index] = true;
    }
    next = static_cast<uint32_t>(std::count(seen.begin(), seen.end(), true));
    EXPECT_TRUE(std::all_of(seen.begin(), seen.begin() + next, [](bool s) { return s; })) << i;
  }
  EXPECT_LT(next, 0.7 * count);
  EXPECT_TRUE(std::is_sorted(part.vertices.begin(), part.vertices.end()));
  for (size_t i = 0; i < part.vertices.size(); ++i) {
    EXPECT_EQ(part.position_deltas[i], mesh.positions[part.vertices[i]]);
  }
  for (uint32_t vertex = 0; vertex < count; ++vertex) {
    EXPECT_EQ(human.cloths[0].vertex_weights[vertex],
              mesh.positions[vertex] +
                  glm::vec3(static_cast<float>(human.cloths[0].vertex_triangle[vertex])));
  }
}

cv::Mat Decode(const human::Texture& texture) {
  const cv::Mat bytes(1, static_cast<int>(texture.encoded.size()), CV_8U,
                      const_cast<std::byte*>(texture.encoded.data()));
  return cv::imdecode(bytes, cv::IMREAD_UNCHANGED);
}

TEST(CastPaint, DyesWhatIsCoveredAndKeepsTheCover) {
  cv::Mat image(32, 32, CV_8UC4, cv::Scalar(40, 40, 40, 255));
  image(cv::Rect(0, 0, 32, 16)) = cv::Scalar(90, 90, 90, 0);
  const auto dyed =
      DyedTexture("hair", lararium::test::Png(image), glm::vec3(0.8f, 0.4f, 0.2f), 512);
  ASSERT_TRUE(dyed.ok()) << dyed.message();
  const cv::Mat result = Decode(*dyed);
  ASSERT_EQ(result.channels(), 4);
  const cv::Vec4b below = result.at<cv::Vec4b>(24, 16);
  EXPECT_NEAR(below[2], 204, 2);
  EXPECT_NEAR(below[1], 102, 2);
  EXPECT_NEAR(below[0], 51, 2);
  EXPECT_EQ(below[3], 255);
  EXPECT_EQ(result.at<cv::Vec4b>(8, 16)[3], 0);
}

TEST(CastPaint, BringsTheSkinToItsTintAndOnlyPaintsHairsWhereTheyGrow) {
  const cv::Mat image(64, 64, CV_8UC3, cv::Scalar(150, 180, 220));
  // Two triangles cover the whole image; hair is on the vertices at the left.
  const std::vector<glm::vec2> uvs = {{0, 0}, {0.1, 0}, {0, 1}, {0.1, 1}, {1, 0}, {1, 1}};
  const std::vector<uint32_t> indices = {0, 1, 2, 1, 3, 2, 1, 4, 3, 4, 5, 3};
  SkinPaint paint;
  paint.uvs = uvs;
  paint.indices = indices;
  paint.tint = glm::vec3(0.6f, 0.4f, 0.3f);
  const auto plain = SkinTexture("skin", lararium::test::Png(image), paint);
  ASSERT_TRUE(plain.ok()) << plain.message();
  const cv::Scalar mean = cv::mean(Decode(*plain));
  EXPECT_NEAR(mean[2], 0.6 * 255, 4.0);
  EXPECT_NEAR(mean[1], 0.4 * 255, 4.0);
  EXPECT_NEAR(mean[0], 0.3 * 255, 4.0);

  paint.stubble = 1.0f;
  paint.beard = {1.0f, 1.0f, 1.0f, 1.0f, 0.0f, 0.0f};
  const auto shaved = SkinTexture("skin", lararium::test::Png(image), paint);
  ASSERT_TRUE(shaved.ok());
  const cv::Mat result = Decode(*shaved);
  const double left = cv::mean(result(cv::Rect(10, 100, 60, 800)))[1];
  const double right = cv::mean(result(cv::Rect(800, 100, 200, 800)))[1];
  EXPECT_LT(left, 0.85 * right);
}

TEST(CastPaint, RefusesWhatIsNoPicture) {
  const std::vector<std::byte> noise(100, std::byte{7});
  EXPECT_FALSE(DyedTexture("hair", noise, std::nullopt, 512).ok());
  EXPECT_FALSE(SkinTexture("skin", {}, {}).ok());
}

}  // namespace
}  // namespace lararium::import
