#include "editor/panels/viewport/gizmo.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>

namespace lararium::panels {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using geometry::Similarity3;

ViewCamera SomeView() {
  OrbitCamera orbit;
  orbit.target = Vector3d(0.2, 0.1, 0.0);
  orbit.distance = 3.0;
  return orbit.View({50.0, 30.0}, {900.0, 700.0});
}

Similarity3 SomeThing() {
  return {1.5, Eigen::Quaterniond(Eigen::AngleAxisd(0.7, Vector3d(1, 2, 3).normalized())),
          Vector3d(0.4, -0.2, 0.3)};
}

TEST(NearestOnAxis, FindsWhereARayCrossesTheAxis) {
  const Vector3d origin(1.0, 2.0, 3.0);
  const Vector3d axis = Vector3d(1.0, 1.0, 0.0).normalized();
  const Vector3d eye(5.0, -3.0, 8.0);
  const Vector3d on_axis = origin + 1.7 * axis;
  const Ray ray{eye, (on_axis - eye).normalized()};
  EXPECT_NEAR(*NearestOnAxis(ray, origin, axis), 1.7, 1e-12);
}

TEST(NearestOnAxis, TakesTheFootOfTheCommonPerpendicularOfSkewLines) {
  const Ray ray{{2.0, 5.0, 1.0}, -Vector3d::UnitY()};
  EXPECT_NEAR(*NearestOnAxis(ray, Vector3d::Zero(), Vector3d::UnitX()), 2.0, 1e-12);
}

TEST(NearestOnAxis, RefusesAnAxisSeenEndOnAndOneBehind) {
  const Ray ray{{0.0, 1.0, 5.0}, -Vector3d::UnitZ()};
  EXPECT_FALSE(NearestOnAxis(ray, Vector3d::Zero(), Vector3d::UnitZ()).has_value());
  EXPECT_FALSE(NearestOnAxis(ray, {0.0, 0.0, 9.0}, Vector3d::UnitX()).has_value());
}

TEST(MeetPlane, MeetsOnlyWhatLiesAhead) {
  const Ray ray{{0.0, 2.0, 0.0}, Vector3d(1.0, -1.0, 0.0).normalized()};
  EXPECT_TRUE(
      MeetPlane(ray, Vector3d::Zero(), Vector3d::UnitY())->isApprox(Vector3d(2.0, 0.0, 0.0)));
  EXPECT_FALSE(MeetPlane(ray, {0.0, 3.0, 0.0}, Vector3d::UnitY()).has_value());
  EXPECT_FALSE(MeetPlane(ray, Vector3d::Zero(), Vector3d::UnitZ()).has_value());
}

class GizmoHandles : public testing::TestWithParam<GizmoMode> {};

TEST_P(GizmoHandles, AreFoundWhereTheyAreDrawn) {
  const ViewCamera view = SomeView();
  const GizmoLayout layout(SomeThing(), view);
  for (const GizmoHandle handle : HandlesOf(GetParam())) {
    const std::vector<Vector2d> outline = layout.Outline(handle, view);
    ASSERT_FALSE(outline.empty());
    Vector2d grip = outline.back();  // The tip of an arrow.
    if (outline.size() == 4) {
      grip = 0.25 * (outline[0] + outline[1] + outline[2] + outline[3]);
    } else if (outline.size() > 4) {
      // A point of a ring, away from its crossings with the others.
      grip = outline[outline.size() / 8];
    }
    EXPECT_EQ(PickHandle(layout, GetParam(), view, grip), handle);
  }
  EXPECT_EQ(PickHandle(layout, GetParam(), view, {60.0, 40.0}), std::nullopt);
}

INSTANTIATE_TEST_SUITE_P(Modes,
                         GizmoHandles,
                         testing::Values(GizmoMode::kMove, GizmoMode::kTurn, GizmoMode::kScale));

TEST(GizmoFreedom, WhatStandsUprightTurnsAboutItsOwnVerticalAlone) {
  EXPECT_EQ(HandlesOf(GizmoMode::kMove, GizmoFreedom::kUpright), HandlesOf(GizmoMode::kMove));
  EXPECT_EQ(HandlesOf(GizmoMode::kTurn, GizmoFreedom::kUpright),
            std::vector<GizmoHandle>{GizmoHandle::kTurnY});
  EXPECT_TRUE(HandlesOf(GizmoMode::kScale, GizmoFreedom::kUpright).empty());
  const ViewCamera view = SomeView();
  const GizmoLayout layout(SomeThing(), view);
  const Vector2d on_other_ring = layout.Outline(GizmoHandle::kTurnX, view)[8];
  EXPECT_EQ(PickHandle(layout, GizmoMode::kTurn, view, on_other_ring), GizmoHandle::kTurnX);
  EXPECT_NE(PickHandle(layout, GizmoMode::kTurn, view, on_other_ring, GizmoFreedom::kUpright),
            GizmoHandle::kTurnX);
}

TEST(GizmoLayout, ArmsHaveTheSameSizeAtAnyDistance) {
  for (const double distance : {0.5, 3.0, 40.0}) {
    OrbitCamera orbit;
    orbit.azimuth = 0.0;
    orbit.elevation = 0.0;
    orbit.distance = distance;
    const ViewCamera view = orbit.View({0.0, 0.0}, {900.0, 700.0});
    const GizmoLayout layout(Similarity3{}, view);
    const std::vector<Vector2d> arrow = layout.Outline(GizmoHandle::kMoveX, view);
    EXPECT_NEAR((arrow[1] - arrow[0]).norm(), GizmoLayout::kArmPx, 1e-6);
  }
}

TEST(GizmoDrag, AnArrowMovesAlongItsAxisOnly) {
  const ViewCamera view = SomeView();
  const Similarity3 start = SomeThing();
  const Vector3d axis = start.rotation * Vector3d::UnitY();
  const Vector2d from = *view.Project(start.translation + 0.1 * axis);
  const Vector2d to = *view.Project(start.translation + 0.6 * axis);
  std::optional<GizmoDrag> drag = GizmoDrag::Begin(GizmoHandle::kMoveY, start, view, from);
  ASSERT_TRUE(drag.has_value());
  const Similarity3 moved = drag->Update(view, to);
  EXPECT_TRUE(moved.translation.isApprox(start.translation + 0.5 * axis, 1e-9));
  EXPECT_TRUE(moved.rotation.isApprox(start.rotation));
  EXPECT_EQ(moved.scale, start.scale);
}

TEST(GizmoDrag, APlaneKeepsThePointBelowThePointer) {
  const ViewCamera view = SomeView();
  const Similarity3 start = SomeThing();
  const Vector3d x = start.rotation * Vector3d::UnitX();
  const Vector3d z = start.rotation * Vector3d::UnitZ();
  const Vector3d grip = start.translation + 0.05 * x + 0.05 * z;
  const Vector3d goal = grip + 0.3 * x - 0.2 * z;
  std::optional<GizmoDrag> drag =
      GizmoDrag::Begin(GizmoHandle::kMoveZx, start, view, *view.Project(grip));
  ASSERT_TRUE(drag.has_value());
  const Similarity3 moved = drag->Update(view, *view.Project(goal));
  EXPECT_TRUE(moved.translation.isApprox(start.translation + 0.3 * x - 0.2 * z, 1e-9));
}

TEST(GizmoDrag, ARingTurnsByTheAngleDraggedAndKeepsThePlace) {
  const ViewCamera view = SomeView();
  const Similarity3 start = SomeThing();
  const Vector3d axis = start.rotation * Vector3d::UnitZ();
  const auto on_ring = [&](double angle) {
    const Vector3d in_thing(0.3 * std::cos(angle), 0.3 * std::sin(angle), 0.0);
    return *view.Project(start.translation + start.rotation * in_thing);
  };
  std::optional<GizmoDrag> drag = GizmoDrag::Begin(GizmoHandle::kTurnZ, start, view, on_ring(0.4));
  ASSERT_TRUE(drag.has_value());
  const Similarity3 turned = drag->Update(view, on_ring(0.4 - 1.9));
  const Eigen::AngleAxisd turn(turned.rotation * start.rotation.conjugate());
  EXPECT_NEAR(turn.angle() * turn.axis().dot(axis), -1.9, 1e-9);
  EXPECT_TRUE(turned.translation.isApprox(start.translation));
}

TEST(GizmoDrag, ScaleFollowsTheDistanceFromTheCentre) {
  const ViewCamera view = SomeView();
  const Similarity3 start = SomeThing();
  const Vector2d middle = *view.Project(start.translation);
  std::optional<GizmoDrag> drag =
      GizmoDrag::Begin(GizmoHandle::kScale, start, view, middle + Vector2d(30.0, -40.0));
  ASSERT_TRUE(drag.has_value());
  const Similarity3 scaled = drag->Update(view, middle + Vector2d(60.0, -80.0));
  EXPECT_NEAR(scaled.scale, 2.0 * start.scale, 1e-9);
  EXPECT_TRUE(scaled.translation.isApprox(start.translation));
  EXPECT_NEAR(drag->Update(view, middle).scale, 2.0 * start.scale, 1e-9)
      << "the centre gives no scale: the last one holds";
}

GizmoSnap MoveSteps(double step) {
  GizmoSnap snap;
  snap.move = step;
  return snap;
}

// The transform after a drag of an arrow along its axis. by: the length of the drag.
Similarity3 Dragged(GizmoHandle handle, double by, const GizmoSnap& snap) {
  const ViewCamera view = SomeView();
  const Similarity3 start = SomeThing();
  const Vector3d axis = start.rotation * Vector3d::Unit(AxisOf(handle));
  std::optional<GizmoDrag> drag =
      GizmoDrag::Begin(handle, start, view, *view.Project(start.translation + 0.1 * axis));
  return drag->Update(view, *view.Project(start.translation + (0.1 + by) * axis), snap);
}

TEST(GizmoSnap, AnArrowMovesInSteps) {
  const Similarity3 start = SomeThing();
  const Vector3d axis = start.rotation * Vector3d::UnitX();
  for (const auto& [by, expected] :
       {std::pair{0.12, 0.10}, {0.13, 0.15}, {-0.31, -0.30}, {0.02, 0.0}}) {
    const Similarity3 moved = Dragged(GizmoHandle::kMoveX, by, MoveSteps(0.05));
    EXPECT_TRUE(moved.translation.isApprox(start.translation + expected * axis, 1e-9)) << by;
  }
}

TEST(GizmoSnap, APlaneMovesInStepsAlongBothOfItsAxes) {
  const ViewCamera view = SomeView();
  const Similarity3 start = SomeThing();
  const Vector3d x = start.rotation * Vector3d::UnitX();
  const Vector3d z = start.rotation * Vector3d::UnitZ();
  std::optional<GizmoDrag> drag =
      GizmoDrag::Begin(GizmoHandle::kMoveZx, start, view, *view.Project(start.translation));
  ASSERT_TRUE(drag.has_value());
  const Similarity3 moved =
      drag->Update(view, *view.Project(start.translation + 0.317 * x - 0.184 * z), MoveSteps(0.01));
  EXPECT_TRUE(moved.translation.isApprox(start.translation + 0.32 * x - 0.18 * z, 1e-9));
}

TEST(GizmoSnap, ARingTurnsInSteps) {
  const ViewCamera view = SomeView();
  const Similarity3 start = SomeThing();
  const Vector3d axis = start.rotation * Vector3d::UnitZ();
  const auto on_ring = [&](double angle) {
    const Vector3d in_thing(0.3 * std::cos(angle), 0.3 * std::sin(angle), 0.0);
    return *view.Project(start.translation + start.rotation * in_thing);
  };
  const double step = 5.0 / 180.0 * std::numbers::pi;
  GizmoSnap snap;
  snap.turn = step;
  std::optional<GizmoDrag> drag = GizmoDrag::Begin(GizmoHandle::kTurnZ, start, view, on_ring(0.4));
  ASSERT_TRUE(drag.has_value());
  const Similarity3 turned = drag->Update(view, on_ring(0.4 + 6.4 * step), snap);
  const Eigen::AngleAxisd turn(turned.rotation * start.rotation.conjugate());
  EXPECT_NEAR(turn.angle() * turn.axis().dot(axis), 6.0 * step, 1e-9);
}

TEST(GizmoSnap, ScalesByStepsAndNeverToNothing) {
  const ViewCamera view = SomeView();
  const Similarity3 start = SomeThing();
  const Vector2d middle = *view.Project(start.translation);
  std::optional<GizmoDrag> drag =
      GizmoDrag::Begin(GizmoHandle::kScale, start, view, middle + Vector2d(100.0, 0.0));
  ASSERT_TRUE(drag.has_value());
  GizmoSnap snap;
  snap.scale = 0.05;
  EXPECT_NEAR(drag->Update(view, middle + Vector2d(0.0, 132.0), snap).scale, 1.3 * start.scale,
              1e-9);
  EXPECT_NEAR(drag->Update(view, middle + Vector2d(2.1, 0.0), snap).scale, 0.05 * start.scale,
              1e-9);
}

// A plane at the given depth below the object's origin along its Y axis. The plane's normal is
// slightly tilted against that axis.
GizmoSnap FloorBelow(double depth, double reach) {
  const Similarity3 start = SomeThing();
  const Vector3d y = start.rotation * Vector3d::UnitY();
  const Vector3d normal = Eigen::AngleAxisd(0.1, start.rotation * Vector3d::UnitX()) * y;
  GizmoSnap snap = MoveSteps(0.05);
  snap.floor = GizmoSnap::Plane{start.translation - depth * y, normal, reach};
  return snap;
}

TEST(GizmoSnap, StopsAtTheFloorBetweenSteps) {
  const Similarity3 start = SomeThing();
  const Vector3d y = start.rotation * Vector3d::UnitY();
  const GizmoSnap snap = FloorBelow(0.237, 0.02);
  const Similarity3 laid = Dragged(GizmoHandle::kMoveY, -0.228, snap);
  EXPECT_TRUE(laid.translation.isApprox(start.translation - 0.237 * y, 1e-9));
  // Too far from the plane, only the steps apply.
  const Similarity3 above = Dragged(GizmoHandle::kMoveY, -0.21, snap);
  EXPECT_TRUE(above.translation.isApprox(start.translation - 0.2 * y, 1e-9));
}

TEST(GizmoSnap, APlaneThatLeadsToTheFloorStopsThereAndKeepsItsStepsAlongIt) {
  const ViewCamera view = SomeView();
  const Similarity3 start = SomeThing();
  const Vector3d x = start.rotation * Vector3d::UnitX();
  const Vector3d y = start.rotation * Vector3d::UnitY();
  std::optional<GizmoDrag> drag =
      GizmoDrag::Begin(GizmoHandle::kMoveXy, start, view, *view.Project(start.translation));
  ASSERT_TRUE(drag.has_value());
  const Similarity3 moved = drag->Update(
      view, *view.Project(start.translation + 0.112 * x - 0.23 * y), FloorBelow(0.237, 0.02));
  EXPECT_TRUE(moved.translation.isApprox(start.translation + 0.1 * x - 0.237 * y, 1e-9));
}

TEST(GizmoSnap, MovesAlongTheFloorAreNotPulledToIt) {
  const Similarity3 start = SomeThing();
  const Vector3d x = start.rotation * Vector3d::UnitX();
  const Similarity3 moved = Dragged(GizmoHandle::kMoveX, 0.1, FloorBelow(0.01, 0.02));
  EXPECT_TRUE(moved.translation.isApprox(start.translation + 0.1 * x, 1e-9));
}

TEST(GizmoDrag, ComingBackToTheBeginningRestoresTheTransform) {
  const ViewCamera view = SomeView();
  const Similarity3 start = SomeThing();
  for (const GizmoMode mode : {GizmoMode::kMove, GizmoMode::kTurn, GizmoMode::kScale}) {
    for (const GizmoHandle handle : HandlesOf(mode)) {
      const GizmoLayout layout(start, view);
      const Vector2d grip = layout.Outline(handle, view).back();
      std::optional<GizmoDrag> drag = GizmoDrag::Begin(handle, start, view, grip);
      ASSERT_TRUE(drag.has_value());
      drag->Update(view, grip + Vector2d(40.0, 25.0));
      const Similarity3 back = drag->Update(view, grip);
      EXPECT_TRUE(back.translation.isApprox(start.translation, 1e-9));
      EXPECT_TRUE(back.rotation.isApprox(start.rotation, 1e-9));
      EXPECT_NEAR(back.scale, start.scale, 1e-9);
    }
  }
}

}  // namespace
}  // namespace lararium::panels
