#include "editor/panels/viewport/model_point.h"

#include <gtest/gtest.h>

#include "shared/geometry/glm_convert.h"

namespace lararium::panels {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// A camera at the origin that looks along +z.
ViewCamera Ahead() {
  ViewCamera view;
  view.focal_x = view.focal_y = 500.0;
  view.center = {400.0, 300.0};
  return view;
}

class FindModelPointTest : public testing::Test {
 protected:
  std::optional<ModelPoint> At(const Vector2d& pixel) const {
    return FindModelPoint(mesh_, vision::OccluderTree(vision::Placed(mesh_, {})), world_from_mesh_,
                          Ahead(), pixel, 8.0);
  }
  Vector2d Seen(const Vector3d& on_mesh) const {
    return *Ahead().Project(world_from_mesh_ * on_mesh);
  }

  // Two squares in centimetres; the second is larger and lies behind the first.
  const geometry::TriangleMesh mesh_ = {{{-50, -50, 0},
                                         {50, -50, 0},
                                         {50, 50, 0},
                                         {-50, 50, 0},
                                         {-80, -80, 60},
                                         {80, -80, 60},
                                         {80, 80, 60},
                                         {-80, 80, 60},
                                         {20, 20, 60}},
                                        {},
                                        {0, 1, 2, 0, 2, 3, 4, 5, 8, 5, 6, 8, 6, 7, 8, 7, 4, 8}};
  const geometry::Similarity3 world_from_mesh_ = {
      0.01, Eigen::Quaterniond(Eigen::AngleAxisd(0.2, Vector3d::UnitY())), {0.1, 0.0, 4.0}};
};

TEST_F(FindModelPointTest, SnapsToTheNearestVertexThatIsSeen) {
  const auto found = At(Seen({50, 50, 0}) + Vector2d(4.0, -3.0));
  ASSERT_TRUE(found.has_value());
  EXPECT_TRUE(found->vertex);
  EXPECT_EQ(found->on_mesh, Vector3d(50, 50, 0));
}

TEST_F(FindModelPointTest, ElsewhereIsWhereTheRayMeetsTheSurface) {
  const Vector3d expected(13.0, -21.0, 0.0);
  const auto found = At(Seen(expected));
  ASSERT_TRUE(found.has_value());
  EXPECT_FALSE(found->vertex);
  EXPECT_LT((found->on_mesh - expected).norm(), 1e-3);
}

TEST_F(FindModelPointTest, AVertexBehindTheModelIsNotMeant) {
  const auto found = At(Seen({20, 20, 60}));
  ASSERT_TRUE(found.has_value());
  EXPECT_FALSE(found->vertex);
  EXPECT_NEAR(found->on_mesh.z(), 0.0, 1e-3);  // The front square.
}

TEST_F(FindModelPointTest, BesideTheModelIsNothing) { EXPECT_FALSE(At({5.0, 5.0}).has_value()); }

}  // namespace
}  // namespace lararium::panels
