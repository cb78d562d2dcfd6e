#include "shared/render/passes/closed_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "tests/render/test_people.h"

namespace lararium::render {
namespace {

const std::vector<glm::vec3> kCorners = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
const std::vector<uint32_t> kTetrahedron = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};

TEST(ClosedSurface, ATetrahedronIsOne) { EXPECT_TRUE(IsClosedSurface(kCorners, kTetrahedron)); }

TEST(ClosedSurface, OneThatFacesInwardsIsNot) {
  std::vector<uint32_t> inverted(kTetrahedron.rbegin(), kTetrahedron.rend());
  EXPECT_FALSE(IsClosedSurface(kCorners, inverted));
}

TEST(ClosedSurface, AHoleOrATurnedTriangleOpensIt) {
  EXPECT_FALSE(IsClosedSurface(kCorners, std::span(kTetrahedron).first(9)));
  std::vector<uint32_t> turned = kTetrahedron;
  std::swap(turned[0], turned[1]);
  EXPECT_FALSE(IsClosedSurface(kCorners, turned));
}

TEST(ClosedSurface, SeamsOfDoubledVerticesDoNotOpenIt) {
  std::vector<glm::vec3> positions;
  std::vector<uint32_t> indices;
  for (const uint32_t index : kTetrahedron) {
    indices.push_back(static_cast<uint32_t>(positions.size()));
    positions.push_back(kCorners[index]);
  }
  EXPECT_TRUE(IsClosedSurface(positions, indices));
}

TEST(ClosedSurface, ATubeIsNotAndNothingIsNot) {
  const human::SkinnedMesh tube = BendingBox(glm::vec3(1.0f));
  EXPECT_FALSE(IsClosedSurface(tube.positions, tube.indices));
  EXPECT_FALSE(IsClosedSurface({}, {}));
}

}  // namespace
}  // namespace lararium::render
