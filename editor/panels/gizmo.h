#pragma once

// Handles in a viewport to move, turn and scale a thing. The maths is here,
// apart from drawing (gizmo_view.h), so that it can be tested without a window.

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "editor/panels/view_camera.h"
#include "shared/geometry/transform.h"

namespace lararium::panels {

enum class GizmoMode { kMove, kTurn, kScale };

enum class GizmoHandle {
  kMoveX,
  kMoveY,
  kMoveZ,
  kMoveYz,  // in the plane across X
  kMoveZx,  // across Y
  kMoveXy,  // across Z
  kTurnX,
  kTurnY,
  kTurnZ,
  kScale,
};

// The axis 0..2 that a handle moves along, turns about, or (planes) stands across.
int AxisOf(GizmoHandle handle);

double DistanceToSegment(const Eigen::Vector2d& point,
                         const Eigen::Vector2d& a,
                         const Eigen::Vector2d& b);

// Signed length along a unit axis through origin of its point nearest to the
// ray; nullopt where the ray is parallel to the axis or the point lies behind.
std::optional<double> NearestOnAxis(const Ray& ray,
                                    const Eigen::Vector3d& origin,
                                    const Eigen::Vector3d& axis);

// Where the ray meets a plane; nullopt where it looks along it or away from it.
std::optional<Eigen::Vector3d> MeetPlane(const Ray& ray,
                                         const Eigen::Vector3d& origin,
                                         const Eigen::Vector3d& normal);

// How a thing may be moved.
enum class GizmoFreedom {
  kFree,
  kUpright,  // it turns about its own Y alone and keeps its size
};

// Where things lie on the screen.
struct GizmoLayout {
  static constexpr double kArmPx = 86.0;
  static constexpr double kPlaneBeginPx = 26.0;  // squares of the plane handles
  static constexpr double kPlaneEndPx = 44.0;
  static constexpr double kScaleHandlePx = 60.0;  // from the centre, to the upper right
  static constexpr double kGrabPx = 9.0;          // how far from a handle still counts

  // Unit axes and origin of the thing, in the world; arm: world units of kArmPx.
  Eigen::Vector3d origin;
  Eigen::Matrix3d axes;
  double arm;

  GizmoLayout(const geometry::Similarity3& world_from_thing, const ViewCamera& view);

  // Outline of a handle in window pixels: the ends of an arrow, the corners of a
  // square, points of a ring. Empty where it is not (wholly) visible.
  std::vector<Eigen::Vector2d> Outline(GizmoHandle handle, const ViewCamera& view) const;
};

const std::vector<GizmoHandle>& HandlesOf(GizmoMode mode,
                                          GizmoFreedom freedom = GizmoFreedom::kFree);

// The handle below a pixel.
std::optional<GizmoHandle> PickHandle(const GizmoLayout& layout,
                                      GizmoMode mode,
                                      const ViewCamera& view,
                                      const Eigen::Vector2d& pixel,
                                      GizmoFreedom freedom = GizmoFreedom::kFree);

// The steps of a drag from where it began. World units of a thing whose axes are turned but not
// scaled; 0: no steps.
struct GizmoSnap {
  double move = 0.0;   // along each axis that a handle moves
  double turn = 0.0;   // radians
  double scale = 0.0;  // share of the scale at the beginning
  // Moves that lead up or down stop where the thing's origin meets this plane.
  struct Plane {
    Eigen::Vector3d point = Eigen::Vector3d::Zero();
    Eigen::Vector3d normal = Eigen::Vector3d::UnitY();  // unit
    double reach = 0.0;                                 // how near it has to be
  };
  std::optional<Plane> floor;
};

// One drag of a handle. Each position of the pointer gives the thing's transform
// anew from where the drag began, so that nothing drifts.
class GizmoDrag {
 public:
  // nullopt where the handle cannot be dragged from there (seen end on).
  static std::optional<GizmoDrag> Begin(GizmoHandle handle,
                                        const geometry::Similarity3& world_from_thing,
                                        const ViewCamera& view,
                                        const Eigen::Vector2d& pixel);

  // world_from_thing with the pointer at pixel; the last one that made sense
  // where the ray misses.
  geometry::Similarity3 Update(const ViewCamera& view,
                               const Eigen::Vector2d& pixel,
                               const GizmoSnap& snap = {});

  GizmoHandle handle() const { return handle_; }

 private:
  GizmoDrag(GizmoHandle handle, const geometry::Similarity3& start)
      : handle_(handle), start_(start), last_(start) {}

  // Parameter of the handle below a pixel: a length, an angle, a point.
  std::optional<Eigen::Vector3d> Parameter(const ViewCamera& view,
                                           const Eigen::Vector2d& pixel) const;
  Eigen::Vector3d SnappedMove(const Eigen::Vector3d& move, const GizmoSnap& snap) const;
  // The direction of moves of this handle that leads to the plane most steeply; nullopt where
  // they go along it rather than to it.
  std::optional<Eigen::Vector3d> WayTo(const GizmoSnap::Plane& plane) const;

  GizmoHandle handle_;
  geometry::Similarity3 start_;
  geometry::Similarity3 last_;
  Eigen::Vector3d start_parameter_ = Eigen::Vector3d::Zero();
};

}  // namespace lararium::panels
