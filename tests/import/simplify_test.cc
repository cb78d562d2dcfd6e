#include "editor/import/model/simplify.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace lararium::import {
namespace {

struct Triangles {
  std::vector<glm::vec3> positions;
  std::vector<uint32_t> indices;
};

// A square of `side` metres with cells x cells squares of two triangles, raised in the middle
// by `rise`.
Triangles Grid(int cells, float side, float rise) {
  Triangles grid;
  for (int y = 0; y <= cells; ++y) {
    for (int x = 0; x <= cells; ++x) {
      const float u = static_cast<float>(x) / static_cast<float>(cells);
      const float v = static_cast<float>(y) / static_cast<float>(cells);
      grid.positions.emplace_back(side * u, rise * 16.0f * u * (1 - u) * v * (1 - v), side * v);
    }
  }
  for (int y = 0; y < cells; ++y) {
    for (int x = 0; x < cells; ++x) {
      const auto a = static_cast<uint32_t>(y * (cells + 1) + x);
      const auto below = a + static_cast<uint32_t>(cells) + 1;
      grid.indices.insert(grid.indices.end(), {a, below, a + 1, a + 1, below, below + 1});
    }
  }
  return grid;
}

float Area(const Triangles& grid, const std::vector<uint32_t>& indices) {
  float area = 0.0f;
  for (size_t i = 0; i < indices.size(); i += 3) {
    const glm::vec3 a = grid.positions[indices[i]];
    const glm::vec3 ab = grid.positions[indices[i + 1]] - a;
    const glm::vec3 ac = grid.positions[indices[i + 2]] - a;
    const glm::vec3 normal = {ab.y * ac.z - ab.z * ac.y, ab.z * ac.x - ab.x * ac.z,
                              ab.x * ac.y - ab.y * ac.x};
    area += 0.5f * std::sqrt(normal.x * normal.x + normal.y * normal.y + normal.z * normal.z);
  }
  return area;
}

TEST(CoarserLevels, OfAPlaneKeepItAndAreOffByNothing) {
  const Triangles grid = Grid(32, 1.0f, 0.0f);
  const std::vector<human::LevelOfDetail> levels =
      CoarserLevels(grid.positions, grid.indices, grid.indices.size());
  ASSERT_FALSE(levels.empty());
  for (const human::LevelOfDetail& level : levels) {
    EXPECT_NEAR(level.error, 0.0f, 1e-4f);
    // The complete area is covered; the coarsest level may fold over within it.
    EXPECT_GT(Area(grid, level.indices), 0.999f);
    EXPECT_LT(Area(grid, level.indices), 1.2f);
  }
}

TEST(CoarserLevels, OfAHillAreOffByMoreAndMore) {
  const Triangles grid = Grid(64, 1.0f, 0.3f);
  const std::vector<human::LevelOfDetail> levels =
      CoarserLevels(grid.positions, grid.indices, grid.indices.size());
  ASSERT_EQ(levels.size(), static_cast<size_t>(kLevelsOfDetail));
  size_t before = grid.indices.size();
  float error = 0.0f;
  for (const human::LevelOfDetail& level : levels) {
    EXPECT_LT(level.indices.size(), before);
    EXPECT_GT(level.error, error);
    EXPECT_LT(level.error, 0.05f);
    before = level.indices.size();
    error = level.error;
  }
}

// Separate tetrahedra, with `along` of them along each side.
Triangles Pieces(int along) {
  Triangles pieces;
  for (int i = 0; i < along * along * along; ++i) {
    const glm::vec3 corner(i % along, i / along % along, i / along / along);
    const auto first = static_cast<uint32_t>(pieces.positions.size());
    for (const glm::vec3& edge :
         {glm::vec3(0), glm::vec3(1, 0, 0), glm::vec3(0, 1, 0), glm::vec3(0, 0, 1)}) {
      pieces.positions.push_back(0.01f * (corner + 0.4f * edge));
    }
    for (const uint32_t k : {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3}) {
      pieces.indices.push_back(first + k);
    }
  }
  return pieces;
}

TEST(CoarserLevels, OfManyPiecesGoOnWherePiecesCannotBecomeSimpler) {
  const Triangles pieces = Pieces(12);
  const std::vector<human::LevelOfDetail> levels =
      CoarserLevels(pieces.positions, pieces.indices, pieces.indices.size());
  ASSERT_GE(levels.size(), 4u);
  EXPECT_LT(levels.back().indices.size(), pieces.indices.size() / 32);
  for (const human::LevelOfDetail& level : levels) {
    EXPECT_GT(level.error, 0.001f);
    EXPECT_LT(level.error, 0.05f);
  }
}

TEST(CoarserLevels, TakeSharesOfTheWhole) {
  const Triangles grid = Grid(32, 1.0f, 0.3f);
  const std::vector<human::LevelOfDetail> levels =
      CoarserLevels(grid.positions, grid.indices, 8 * grid.indices.size());
  ASSERT_FALSE(levels.empty());
  // An eighth of `whole` is the complete grid, which becomes a level.
  EXPECT_EQ(levels.front().indices.size(), grid.indices.size());
}

TEST(CoarserLevels, OfNothingOrLittleAreNone) {
  EXPECT_TRUE(CoarserLevels({}, {}, 0).empty());
  const Triangles grid = Grid(3, 1.0f, 0.1f);
  EXPECT_TRUE(CoarserLevels(grid.positions, grid.indices, grid.indices.size()).empty());
}

TEST(MeanEdge, OfARightAngledTriangle) {
  const std::vector<glm::vec3> positions = {{0, 0, 0}, {3, 0, 0}, {0, 4, 0}};
  const std::vector<uint32_t> indices = {0, 1, 2};
  EXPECT_FLOAT_EQ(MeanEdge(positions, indices), 4.0f);
  EXPECT_EQ(MeanEdge(positions, {}), 0.0f);
}

}  // namespace
}  // namespace lararium::import
