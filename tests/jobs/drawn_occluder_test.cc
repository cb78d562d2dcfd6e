#include "editor/jobs/drawn_occluder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "editor/document/picked_images.h"
#include "shared/geometry/glm_convert.h"
#include "tests/support/synthetic_world.h"

namespace lararium::editor {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using testing::HasSubstr;

class DrawnOccluderTest : public testing::Test {
 protected:
  // Picks a point of the map in keyframes, each with the same error.
  void Pick(OccluderDocument& occluder,
            size_t corner,
            const Vector3d& point,
            std::initializer_list<size_t> keyframes,
            const Vector2d& off = Vector2d::Zero()) {
    for (const size_t k : keyframes) {
      const vision::Keyframe& keyframe = map_.keyframes[k];
      const auto pixel = map_.camera.Project(keyframe.camera_from_map * point);
      ASSERT_TRUE(pixel);
      SetCorner(occluder, corner, keyframe, *pixel + off);
    }
  }
  OccluderDocument Draw(const std::vector<Vector3d>& corners) {
    OccluderDocument occluder;
    occluder.name = "counter";
    for (size_t i = 0; i < corners.size(); ++i) {
      Pick(occluder, i, corners[i], {0, 5, 11});
    }
    return occluder;
  }

  const test::SyntheticWorld world_ = test::MakeSyntheticWorld({});
  const vision::SceneDatabase map_ = test::MakeSceneDatabase(world_);
  const std::vector<Vector3d> face_ = {
      {-0.4, -0.2, 0.3}, {0.4, -0.2, 0.3}, {0.4, 0.3, 0.3}, {-0.4, 0.3, 0.3}};
};

double Area(const geometry::TriangleMesh& mesh) {
  double area = 0.0;
  for (size_t i = 0; i < mesh.indices.size(); i += 3) {
    const glm::vec3& a = mesh.positions[mesh.indices[i]];
    area += 0.5 * glm::length(glm::cross(mesh.positions[mesh.indices[i + 1]] - a,
                                         mesh.positions[mesh.indices[i + 2]] - a));
  }
  return area;
}

// The volume of a closed mesh whose triangles face outwards (divergence theorem).
double Volume(const geometry::TriangleMesh& mesh) {
  double volume = 0.0;
  for (size_t i = 0; i < mesh.indices.size(); i += 3) {
    volume +=
        glm::dot(mesh.positions[mesh.indices[i]], glm::cross(mesh.positions[mesh.indices[i + 1]],
                                                             mesh.positions[mesh.indices[i + 2]])) /
        6.0;
  }
  return volume;
}

TEST_F(DrawnOccluderTest, ACornerThatIsPickedNowhereAnyMoreIsGone) {
  OccluderDocument occluder = Draw(face_);
  const stage::Pick second = occluder.corners[1].picks[1];
  EXPECT_TRUE(RemoveCornerPick(occluder, 1, second));
  EXPECT_FALSE(RemoveCornerPick(occluder, 1, second));
  EXPECT_FALSE(RemoveCornerPick(occluder, 4, second));
  ASSERT_EQ(occluder.corners.size(), 4u);
  EXPECT_EQ(occluder.corners[1].picks.size(), 2u);
  EXPECT_EQ(occluder.corners[0].picks.size(), 3u);
  const std::vector<stage::Pick> behind = occluder.corners[2].picks;
  for (const stage::Pick& pick : std::vector<stage::Pick>(occluder.corners[1].picks)) {
    EXPECT_TRUE(RemoveCornerPick(occluder, 1, pick));
  }
  ASSERT_EQ(occluder.corners.size(), 3u);
  EXPECT_EQ(occluder.corners[1].name, CornerName(1));
  EXPECT_EQ(occluder.corners[1].picks[0].pixel, behind[0].pixel);
}

TEST_F(DrawnOccluderTest, CornersLieWhereTheyWerePicked) {
  const auto drawn = DrawOccluder(Draw(face_), map_, 1.0);
  ASSERT_TRUE(drawn.ok()) << drawn.message();
  EXPECT_LT(drawn->error_px, 1e-6);
  EXPECT_LT(drawn->unevenness, 1e-9);
  ASSERT_EQ(drawn->corners.size(), 4u);
  for (size_t i = 0; i < face_.size(); ++i) {
    EXPECT_LT((drawn->corners[i].point_in_map - face_[i]).norm(), 1e-9) << i;
    EXPECT_EQ(drawn->corners[i].picks, 3);
  }
  EXPECT_TRUE(drawn->mesh_in_map.Validate("face").ok());
  EXPECT_NEAR(Area(drawn->mesh_in_map), 0.8 * 0.5, 1e-6);
}

TEST_F(DrawnOccluderTest, AFlatOneLiesOnThePlaneThatFitsItsCornersBest) {
  std::vector<Vector3d> corners = face_;
  corners[1].z() += 0.05;
  corners[3].z() += 0.02;
  OccluderDocument occluder = Draw(corners);
  occluder.depth = 0.3;
  const auto uneven = DrawOccluder(occluder, map_, 1.0);
  occluder.flat = true;
  const auto flat = DrawOccluder(occluder, map_, 1.0);
  ASSERT_TRUE(uneven.ok() && flat.ok()) << uneven.message() << flat.message();
  EXPECT_GT(uneven->unevenness, 0.01);
  EXPECT_EQ(flat->unevenness, uneven->unevenness);  // The distance before the corners were moved.
  const auto corner = [](const DrawnOccluder& drawn, size_t i) {
    return geometry::ToEigen(drawn.mesh_in_map.positions[i]);
  };
  const auto off_plane = [&](const DrawnOccluder& drawn) {
    const Vector3d normal = (corner(drawn, 1) - corner(drawn, 0))
                                .cross(corner(drawn, 2) - corner(drawn, 0))
                                .normalized();
    return std::abs(normal.dot(corner(drawn, 3) - corner(drawn, 0)));
  };
  EXPECT_GT(off_plane(*uneven), 0.02);
  EXPECT_LT(off_plane(*flat), 1e-6);
  double farthest = 0.0;
  for (size_t i = 0; i < 4; ++i) {
    farthest = std::max(farthest, (corner(*flat, i) - corner(*uneven, i)).norm());
  }
  EXPECT_NEAR(farthest, uneven->unevenness, 1e-6);
}

TEST_F(DrawnOccluderTest, PicksThatDisagreeAreTold) {
  OccluderDocument occluder = Draw(face_);
  Pick(occluder, 2, face_[2], {5}, Vector2d(0.0, 3.0));
  const auto drawn = DrawOccluder(occluder, map_, 1.0);
  ASSERT_TRUE(drawn.ok()) << drawn.message();
  EXPECT_GT(drawn->corners[2].error_px, 0.5);
  EXPECT_LT(drawn->corners[2].error_px, 3.0);
  EXPECT_LT(drawn->corners[1].error_px, 1e-6);
  // Of all twelve picks, only the three of this corner have an error.
  EXPECT_NEAR(drawn->error_px, drawn->corners[2].error_px / 2.0, 1e-6);
}

TEST_F(DrawnOccluderTest, ADepthMakesAPrismAwayFromWhereItWasDrawn) {
  for (const bool reversed : {false, true}) {  // Clockwise or counter-clockwise.
    std::vector<Vector3d> corners = face_;
    if (reversed) {
      std::reverse(corners.begin(), corners.end());
    }
    OccluderDocument occluder = Draw(corners);
    occluder.depth = 0.1;
    const auto drawn = DrawOccluder(occluder, map_, 2.0);  // 0.2 map units.
    ASSERT_TRUE(drawn.ok()) << drawn.message();
    EXPECT_TRUE(drawn->mesh_in_map.Validate("box").ok());
    EXPECT_NEAR(Volume(drawn->mesh_in_map), 0.8 * 0.5 * 0.2, 1e-6);
    const Vector3d camera = map_.keyframes[5].camera_from_map.Center();
    for (size_t i = 4; i < 8; ++i) {
      const Vector3d front = geometry::ToEigen(drawn->mesh_in_map.positions[i - 4]).cast<double>();
      const Vector3d back = geometry::ToEigen(drawn->mesh_in_map.positions[i]).cast<double>();
      EXPECT_NEAR((back - front).norm(), 0.2, 1e-6);
      EXPECT_GT((back - camera).norm(), (front - camera).norm());
    }
  }
}

TEST_F(DrawnOccluderTest, AFaceMayHaveNotches) {
  // An L: 0.6 x 0.6 without a quarter.
  const auto drawn = DrawOccluder(Draw({{-0.3, -0.3, 0.2},
                                        {0.3, -0.3, 0.2},
                                        {0.3, 0.0, 0.2},
                                        {0.0, 0.0, 0.2},
                                        {0.0, 0.3, 0.2},
                                        {-0.3, 0.3, 0.2}}),
                                  map_, 1.0);
  ASSERT_TRUE(drawn.ok()) << drawn.message();
  EXPECT_EQ(drawn->mesh_in_map.indices.size(), 12u);
  EXPECT_NEAR(Area(drawn->mesh_in_map), 0.27, 1e-6);
}

TEST_F(DrawnOccluderTest, WhatIsNotDrawnToItsEndSaysWhatIsMissing) {
  const auto problem = [&](const OccluderDocument& occluder) {
    const auto drawn = DrawOccluder(occluder, map_, 1.0);
    return drawn.ok() ? "" : drawn.message();
  };
  OccluderDocument two = Draw({face_[0], face_[1]});
  EXPECT_THAT(problem(two), HasSubstr("at least three corners"));
  OccluderDocument once = Draw({face_[0], face_[1]});
  Pick(once, 2, face_[2], {4});
  EXPECT_THAT(problem(once), HasSubstr("corner 3 is picked in fewer than two images"));
  EXPECT_THAT(problem(Draw({face_[0], face_[1], 0.5 * (face_[0] + face_[1])})),
              HasSubstr("on a line"));
  EXPECT_THAT(problem(Draw({face_[0], face_[2], face_[1], face_[3]})), HasSubstr("cross"));
  PlaceDocument place;
  place.occluders = {two, Draw(face_)};
  place.occluders[1].name = "whole";
  OccluderDocument model;
  model.name = "model";
  model.file = "a.glb";
  place.occluders.push_back(model);
  const PlaceDocument shown = WithoutDrafts(place, map_);
  ASSERT_EQ(shown.occluders.size(), 2u);
  EXPECT_EQ(shown.occluders[0].name, "whole");
  EXPECT_EQ(shown.occluders[1].name, "model");
}

TEST_F(DrawnOccluderTest, CornersAreAddedInTheFirstImageAndSetInTheOthers) {
  const vision::Keyframe& first = map_.keyframes[2];
  const vision::Keyframe& second = map_.keyframes[7];
  OccluderDocument occluder;
  for (size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(NextCorner(occluder, first), i);
    SetCorner(occluder, i, first, Vector2d(10.0 * static_cast<double>(i), 5.0));
  }
  EXPECT_EQ(NextCorner(occluder, second), 0u);
  SetCorner(occluder, 0, second, {1, 1});
  EXPECT_EQ(NextCorner(occluder, second), 1u);
  EXPECT_EQ(NextCorner(occluder, first), std::nullopt);  // The other corners must be picked next.
  SetCorner(occluder, 1, second, {2, 2});
  SetCorner(occluder, 2, second, {3, 3});
  EXPECT_EQ(NextCorner(occluder, second), std::nullopt);
  EXPECT_EQ(occluder.corners[1].name, "corner 2");

  EXPECT_EQ(CornerNear(occluder, first, {11, 5}, 4.0), 1u);
  EXPECT_EQ(CornerNear(occluder, first, {15, 5}, 4.0), std::nullopt);
  SetCorner(occluder, 1, first, {40, 40});  // This moves the corner.
  EXPECT_EQ(occluder.corners[1].picks.size(), 2u);
  EXPECT_EQ(PickIn(occluder.corners[1], first)->pixel, Vector2d(40, 40));
  EXPECT_EQ(PickIn(occluder.corners[1], map_.keyframes[3]), nullptr);
}

}  // namespace
}  // namespace lararium::editor
