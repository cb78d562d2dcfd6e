#include "editor/import/objects/object_models.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "shared/stage/object_use.h"

namespace lararium::import {
namespace {

class ObjectModels : public ::testing::TestWithParam<std::string_view> {};

INSTANTIATE_TEST_SUITE_P(All,
                         ObjectModels,
                         ::testing::ValuesIn(ObjectModelNames().begin(), ObjectModelNames().end()),
                         [](const auto& info) { return std::string(info.param); });

TEST_P(ObjectModels, AreWholeAndKnowTheirUse) {
  auto prop = BuildObjectModel(GetParam());
  ASSERT_TRUE(prop.ok()) << prop.message();
  EXPECT_TRUE(prop->Validate("here").ok());
  EXPECT_FALSE(prop->use.empty());
  EXPECT_FALSE(prop->credits.empty());
  const auto model = stage::ObjectModel::Create(*std::move(prop), "here");
  ASSERT_TRUE(model.ok()) << model.message();
  // It rests on the ground and fits through a door.
  EXPECT_NEAR((*model)->lower().y, 0.0f, 0.012f);
  EXPECT_LT((*model)->upper().y, 2.2f);
}

// Six times the signed volume between the origin and a triangle; the sum is negative if the
// surface is inside out.
float SignedVolume(const stage::PropMesh& mesh) {
  float sum = 0.0f;
  for (size_t i = 0; i < mesh.indices.size(); i += 3) {
    const glm::vec3& a = mesh.positions[mesh.indices[i]];
    const glm::vec3& b = mesh.positions[mesh.indices[i + 1]];
    const glm::vec3& c = mesh.positions[mesh.indices[i + 2]];
    sum += glm::dot(a, glm::cross(b, c));
  }
  return sum;
}

TEST_P(ObjectModels, ShowTheirOutside) {
  const auto prop = BuildObjectModel(GetParam());
  ASSERT_TRUE(prop.ok());
  for (const stage::PropPart& part : prop->parts) {
    for (const stage::PropMesh& mesh : part.meshes) {
      EXPECT_GT(SignedVolume(mesh), 0.0f) << part.name;
    }
  }
}

TEST_P(ObjectModels, HaveNormalsOfTheirTriangles) {
  const auto prop = BuildObjectModel(GetParam());
  ASSERT_TRUE(prop.ok());
  size_t wrong = 0;
  size_t count = 0;
  for (const stage::PropPart& part : prop->parts) {
    for (const stage::PropMesh& mesh : part.meshes) {
      for (size_t i = 0; i < mesh.indices.size(); i += 3) {
        const uint32_t* corner = &mesh.indices[i];
        const glm::vec3 across = glm::cross(mesh.positions[corner[1]] - mesh.positions[corner[0]],
                                            mesh.positions[corner[2]] - mesh.positions[corner[0]]);
        const glm::vec3 normal =
            mesh.normals[corner[0]] + mesh.normals[corner[1]] + mesh.normals[corner[2]];
        wrong += glm::length(across) > 1e-9f && glm::dot(across, normal) < 0.0f;
        ++count;
      }
    }
  }
  EXPECT_LE(wrong, count / 50);
}

// The point of a triangle nearest to p (Ericson, "Real-Time Collision Detection", 5.1.5, by
// clamping to the edges).
glm::vec3 NearestOf(const glm::vec3& p,
                    const glm::vec3& a,
                    const glm::vec3& b,
                    const glm::vec3& c) {
  const glm::vec3 normal = glm::cross(b - a, c - a);
  const glm::vec3 foot = p - normal * (glm::dot(p - a, normal) / glm::dot(normal, normal));
  const auto outside = [&](const glm::vec3& from, const glm::vec3& to) {
    return glm::dot(glm::cross(to - from, foot - from), normal) < 0.0f;
  };
  const auto on_edge = [&](const glm::vec3& from, const glm::vec3& to) {
    const glm::vec3 way = to - from;
    return from + way * glm::clamp(glm::dot(p - from, way) / glm::dot(way, way), 0.0f, 1.0f);
  };
  if (!outside(a, b) && !outside(b, c) && !outside(c, a)) {
    return foot;
  }
  glm::vec3 nearest = on_edge(a, b);
  for (const glm::vec3& other : {on_edge(b, c), on_edge(c, a)}) {
    nearest = glm::distance(other, p) < glm::distance(nearest, p) ? other : nearest;
  }
  return nearest;
}

// Distance from a point in the frame of the part to its surface.
float DistanceTo(const stage::PropPart& part, const glm::vec3& point) {
  float nearest = std::numeric_limits<float>::infinity();
  for (const stage::PropMesh& mesh : part.meshes) {
    const auto corner = [&](size_t i) { return mesh.positions[mesh.indices[i]]; };
    for (size_t i = 0; i < mesh.indices.size(); i += 3) {
      if (glm::length(glm::cross(corner(i + 1) - corner(i), corner(i + 2) - corner(i))) > 1e-9f) {
        const glm::vec3 at = NearestOf(point, corner(i), corner(i + 1), corner(i + 2));
        nearest = std::min(nearest, glm::distance(at, point));
      }
    }
  }
  return nearest;
}

// A palm touches what it holds, within the thickness of a hand.
TEST_P(ObjectModels, AreHeldWhereTheyAre) {
  const auto prop = BuildObjectModel(GetParam());
  ASSERT_TRUE(prop.ok());
  const auto use = stage::ParseObjectUse(prop->use, *prop, "here");
  ASSERT_TRUE(use.ok()) << use.message();
  for (const stage::Grip& grip : use->grips) {
    if (grip.hand_pose == human::HandPose::kFlat && GetParam() == "brazier") {
      continue;  // Hands that warm themselves keep their distance.
    }
    const stage::PropPart& part = prop->parts[std::max(grip.part, 0)];
    EXPECT_LT(DistanceTo(part, grip.part_from_hand.position), 0.035f) << grip.name;
  }
}

TEST(ObjectModelNames, AreTwentyAtLeastAndOthersAreRefused) {
  EXPECT_GE(ObjectModelNames().size(), 20u);
  const auto none = BuildObjectModel("espresso_machine");
  ASSERT_FALSE(none.ok());
  EXPECT_NE(none.message().find("amphora"), std::string::npos);
}

}  // namespace
}  // namespace lararium::import
