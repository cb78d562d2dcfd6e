#pragma once

// Handles in a viewport that move, rotate and scale an object. The computations are separate from
// drawing (gizmo_view.h), so that they can be tested without a window.

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "editor/panels/viewport/view_camera.h"
#include "shared/geometry/transform.h"

namespace lararium::panels {

enum class GizmoMode { kMove, kTurn, kScale };

enum class GizmoHandle {
  kMoveX,
  kMoveY,
  kMoveZ,
  kMoveYz,  // Moves in the plane normal to X.
  kMoveZx,  // Moves in the plane normal to Y.
  kMoveXy,  // Moves in the plane normal to Z.
  kTurnX,
  kTurnY,
  kTurnZ,
  kScale,
};

// The axis 0..2 of a handle: of its translation or rotation, or the normal of its plane.
int AxisOf(GizmoHandle handle);

double DistanceToSegment(const Eigen::Vector2d& point,
                         const Eigen::Vector2d& a,
                         const Eigen::Vector2d& b);

// The signed length along a unit axis through origin to the point nearest to the ray; nullopt where
// the ray is parallel to the axis or the point lies behind its origin.
std::optional<double> NearestOnAxis(const Ray& ray,
                                    const Eigen::Vector3d& origin,
                                    const Eigen::Vector3d& axis);

// The intersection of the ray with a plane; nullopt where the ray is parallel to it or points away
// from it.
std::optional<Eigen::Vector3d> MeetPlane(const Ray& ray,
                                         const Eigen::Vector3d& origin,
                                         const Eigen::Vector3d& normal);

// The allowed transforms of an object.
enum class GizmoFreedom {
  kFree,
  kUpright,  // Only rotation about its own Y; no scaling.
};

// The handles on the screen.
struct GizmoLayout {
  static constexpr double kArmPx = 86.0;
  static constexpr double kPlaneBeginPx = 26.0;  // Corners of the squares of the plane handles.
  static constexpr double kPlaneEndPx = 44.0;
  static constexpr double kScaleHandlePx = 60.0;  // Distance from the centre to the upper right.
  // The distance from a handle at which it can still be grabbed.
  static constexpr double kGrabPx = 9.0;

  // Origin and unit axes of the object in the world. arm: the length of kArmPx in world units.
  Eigen::Vector3d origin;
  Eigen::Matrix3d axes;
  double arm;

  GizmoLayout(const geometry::Similarity3& world_from_thing, const ViewCamera& view);

  // The outline of a handle in window pixels: the ends of an arrow, the corners of a square, or
  // points of a ring. Empty where it is not completely visible.
  std::vector<Eigen::Vector2d> Outline(GizmoHandle handle, const ViewCamera& view) const;
};

const std::vector<GizmoHandle>& HandlesOf(GizmoMode mode,
                                          GizmoFreedom freedom = GizmoFreedom::kFree);

// The handle at a pixel.
std::optional<GizmoHandle> PickHandle(const GizmoLayout& layout,
                                      GizmoMode mode,
                                      const ViewCamera& view,
                                      const Eigen::Vector2d& pixel,
                                      GizmoFreedom freedom = GizmoFreedom::kFree);

// The step sizes of a drag, relative to its beginning; 0: no steps. World units of an object whose
// axes are rotated but not scaled.
struct GizmoSnap {
  double move = 0.0;   // Along each axis of the handle.
  double turn = 0.0;   // Radians.
  double scale = 0.0;  // Relative to the scale at the beginning.
  // Moves with a vertical component snap to where the object's origin lies in this plane.
  struct Plane {
    Eigen::Vector3d point = Eigen::Vector3d::Zero();
    Eigen::Vector3d normal = Eigen::Vector3d::UnitY();  // Unit length.
    double reach = 0.0;                                 // The distance at which it snaps.
  };
  std::optional<Plane> floor;
};

// One drag of a handle. Each position of the pointer gives a transform relative to the beginning of
// the drag, so errors do not accumulate.
class GizmoDrag {
 public:
  // nullopt where the handle cannot be dragged from this view (it is seen end on).
  static std::optional<GizmoDrag> Begin(GizmoHandle handle,
                                        const geometry::Similarity3& world_from_thing,
                                        const ViewCamera& view,
                                        const Eigen::Vector2d& pixel);

  // world_from_object for the pointer at pixel. Where the ray misses the handle's axis or plane:
  // the last valid transform.
  geometry::Similarity3 Update(const ViewCamera& view,
                               const Eigen::Vector2d& pixel,
                               const GizmoSnap& snap = {});

  GizmoHandle handle() const { return handle_; }

 private:
  GizmoDrag(GizmoHandle handle, const geometry::Similarity3& start)
      : handle_(handle), start_(start), last_(start) {}

  // The parameter of the handle at a pixel: a length, an angle, or a point.
  std::optional<Eigen::Vector3d> Parameter(const ViewCamera& view,
                                           const Eigen::Vector2d& pixel) const;
  Eigen::Vector3d SnappedMove(const Eigen::Vector3d& move, const GizmoSnap& snap) const;
  // The direction of this handle's moves that leads to the plane most steeply; nullopt where they
  // are nearly parallel to it.
  std::optional<Eigen::Vector3d> WayTo(const GizmoSnap::Plane& plane) const;

  GizmoHandle handle_;
  geometry::Similarity3 start_;
  geometry::Similarity3 last_;
  Eigen::Vector3d start_parameter_ = Eigen::Vector3d::Zero();
};

}  // namespace lararium::panels
