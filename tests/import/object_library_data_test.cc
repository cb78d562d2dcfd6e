#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "editor/import/objects/object_import.h"
#include "editor/import/objects/object_library.h"
#include "shared/stage/object_use.h"
#include "tests/support/test_files.h"

namespace lararium::import {
namespace {

using ::testing::HasSubstr;

class LibraryObjects : public ::testing::TestWithParam<std::string> {
 protected:
  LibraryObjects() {
    const auto file = FindLibraryObject(GetParam());
    auto prop = file.ok() ? ImportObject(*file, notes_) : Result<stage::Prop>(file.status());
    EXPECT_TRUE(prop.ok()) << prop.status().message();
    prop_ = prop.ok() ? *std::move(prop) : stage::Prop();
  }

  stage::Prop prop_;
  std::vector<std::string> notes_;
};

INSTANTIATE_TEST_SUITE_P(All,
                         LibraryObjects,
                         ::testing::ValuesIn(LibraryObjectNames()),
                         [](const auto& info) { return info.param; });

TEST_P(LibraryObjects, AreWholeAndKnowTheirUse) {
  EXPECT_THAT(notes_, ::testing::IsEmpty());
  EXPECT_EQ(prop_.name, GetParam());
  EXPECT_FALSE(prop_.use.empty());
  EXPECT_THAT(prop_.credits, HasSubstr("Apache-2.0"));
  const auto model = stage::ObjectModel::Create(prop_, "here");
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

TEST_P(LibraryObjects, ShowTheirOutside) {
  for (const stage::PropPart& part : prop_.parts) {
    for (const stage::PropMesh& mesh : part.meshes) {
      EXPECT_GT(SignedVolume(mesh), 0.0f) << part.name;
    }
  }
}

TEST_P(LibraryObjects, HaveNormalsOfTheirTriangles) {
  size_t wrong = 0;
  size_t count = 0;
  for (const stage::PropPart& part : prop_.parts) {
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
TEST_P(LibraryObjects, AreHeldWhereTheyAre) {
  const auto use = stage::ParseObjectUse(prop_.use, prop_, "here");
  ASSERT_TRUE(use.ok()) << use.message();
  for (const stage::Grip& grip : use->grips) {
    if (grip.hand_pose == human::HandPose::kFlat && GetParam() == "brazier") {
      continue;  // Hands that warm themselves keep their distance.
    }
    const stage::PropPart& part = prop_.parts[std::max(grip.part, 0)];
    EXPECT_LT(DistanceTo(part, grip.part_from_hand.position), 0.035f) << grip.name;
  }
}

TEST(ObjectLibrary, HasTwentyObjectsAtLeastAndNamesThemWhereOneIsUnknown) {
  EXPECT_GE(LibraryObjectNames().size(), 20u);
  const auto none = FindLibraryObject("espresso_machine");
  ASSERT_FALSE(none.ok());
  EXPECT_THAT(none.message(), HasSubstr("espresso_machine"));
  EXPECT_THAT(none.message(), HasSubstr("name one of amphora, "));
}

}  // namespace
}  // namespace lararium::import
