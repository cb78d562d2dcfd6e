#include "editor/panels/viewport/gizmo.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace lararium::panels {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

bool IsPlane(GizmoHandle handle) {
  return handle == GizmoHandle::kMoveYz || handle == GizmoHandle::kMoveZx ||
         handle == GizmoHandle::kMoveXy;
}

bool IsArrow(GizmoHandle handle) {
  return handle == GizmoHandle::kMoveX || handle == GizmoHandle::kMoveY ||
         handle == GizmoHandle::kMoveZ;
}

// Whether a point is inside a convex outline of either orientation.
bool Inside(const std::vector<Vector2d>& corners, const Vector2d& point) {
  bool any_left = false;
  bool any_right = false;
  for (size_t i = 0; i < corners.size(); ++i) {
    const Vector2d edge = corners[(i + 1) % corners.size()] - corners[i];
    const Vector2d offset = point - corners[i];
    const double cross = edge.x() * offset.y() - edge.y() * offset.x();
    any_left |= cross > 0.0;
    any_right |= cross < 0.0;
  }
  return !(any_left && any_right);
}

double DistanceToOutline(GizmoHandle handle,
                         const std::vector<Vector2d>& outline,
                         const Vector2d& pixel) {
  if (outline.empty()) {
    return std::numeric_limits<double>::infinity();
  }
  if (IsPlane(handle) || handle == GizmoHandle::kScale) {
    return Inside(outline, pixel) ? 0.0 : std::numeric_limits<double>::infinity();
  }
  double best = std::numeric_limits<double>::infinity();
  for (size_t i = 0; i + 1 < outline.size(); ++i) {
    best = std::min(best, DistanceToSegment(pixel, outline[i], outline[i + 1]));
  }
  return best;
}

}  // namespace

double DistanceToSegment(const Vector2d& point, const Vector2d& a, const Vector2d& b) {
  const Vector2d along = b - a;
  const double length = along.squaredNorm();
  const double t = length > 0.0 ? std::clamp((point - a).dot(along) / length, 0.0, 1.0) : 0.0;
  return (point - (a + t * along)).norm();
}

int AxisOf(GizmoHandle handle) {
  switch (handle) {
    case GizmoHandle::kMoveX:
    case GizmoHandle::kMoveYz:
    case GizmoHandle::kTurnX:
      return 0;
    case GizmoHandle::kMoveY:
    case GizmoHandle::kMoveZx:
    case GizmoHandle::kTurnY:
      return 1;
    default:
      return 2;
  }
}

std::optional<double> NearestOnAxis(const Ray& ray, const Vector3d& origin, const Vector3d& axis) {
  constexpr double kParallel = 1e-6;
  const Vector3d offset = ray.origin - origin;
  const double cosine = ray.direction.dot(axis);
  const double sine_squared = 1.0 - cosine * cosine;
  if (sine_squared < kParallel) {
    return std::nullopt;
  }
  const double along_ray = (cosine * offset.dot(axis) - offset.dot(ray.direction)) / sine_squared;
  if (along_ray < 0.0) {
    return std::nullopt;
  }
  return (offset + along_ray * ray.direction).dot(axis);
}

std::optional<Vector3d> MeetPlane(const Ray& ray, const Vector3d& origin, const Vector3d& normal) {
  constexpr double kGrazing = 1e-4;
  const double facing = ray.direction.dot(normal);
  if (std::abs(facing) < kGrazing) {
    return std::nullopt;
  }
  const double distance = (origin - ray.origin).dot(normal) / facing;
  if (distance < 0.0) {
    return std::nullopt;
  }
  return ray.At(distance);
}

GizmoLayout::GizmoLayout(const geometry::Similarity3& world_from_thing, const ViewCamera& view)
    : origin(world_from_thing.translation),
      axes(world_from_thing.rotation.toRotationMatrix()),
      arm(kArmPx * view.UnitsPerPixel(origin)) {}

std::vector<Vector2d> GizmoLayout::Outline(GizmoHandle handle, const ViewCamera& view) const {
  const double unit = arm / kArmPx;  // World units per pixel.
  const int axis = AxisOf(handle);
  const Vector3d u = axes.col((axis + 1) % 3);
  const Vector3d v = axes.col((axis + 2) % 3);
  std::vector<Vector3d> points;
  if (IsArrow(handle)) {
    points = {origin, origin + arm * axes.col(axis)};
  } else if (IsPlane(handle)) {
    const double a = kPlaneBeginPx * unit;
    const double b = kPlaneEndPx * unit;
    points = {origin + a * u + a * v, origin + b * u + a * v, origin + b * u + b * v,
              origin + a * u + b * v};
  } else if (handle == GizmoHandle::kScale) {
    const std::optional<Vector2d> middle = view.Project(origin);
    if (!middle) {
      return {};
    }
    const Vector2d at = *middle + Vector2d(kScaleHandlePx, -kScaleHandlePx) / std::numbers::sqrt2;
    return {at + Vector2d(-kGrabPx, -kGrabPx), at + Vector2d(kGrabPx, -kGrabPx),
            at + Vector2d(kGrabPx, kGrabPx), at + Vector2d(-kGrabPx, kGrabPx)};
  } else {
    constexpr int kRingPoints = 64;
    for (int i = 0; i <= kRingPoints; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / kRingPoints;
      points.push_back(origin + arm * (std::cos(angle) * u + std::sin(angle) * v));
    }
  }
  std::vector<Vector2d> outline;
  for (const Vector3d& point : points) {
    const std::optional<Vector2d> pixel = view.Project(point);
    if (!pixel) {
      return {};
    }
    outline.push_back(*pixel);
  }
  return outline;
}

const std::vector<GizmoHandle>& HandlesOf(GizmoMode mode, GizmoFreedom freedom) {
  static const std::vector<GizmoHandle> kMove = {GizmoHandle::kMoveYz, GizmoHandle::kMoveZx,
                                                 GizmoHandle::kMoveXy, GizmoHandle::kMoveX,
                                                 GizmoHandle::kMoveY,  GizmoHandle::kMoveZ};
  static const std::vector<GizmoHandle> kTurn = {GizmoHandle::kTurnX, GizmoHandle::kTurnY,
                                                 GizmoHandle::kTurnZ};
  static const std::vector<GizmoHandle> kScale = {GizmoHandle::kScale};
  static const std::vector<GizmoHandle> kTurnUpright = {GizmoHandle::kTurnY};
  static const std::vector<GizmoHandle> kNone;
  if (freedom == GizmoFreedom::kUpright && mode != GizmoMode::kMove) {
    return mode == GizmoMode::kTurn ? kTurnUpright : kNone;
  }
  switch (mode) {
    case GizmoMode::kMove:
      return kMove;
    case GizmoMode::kTurn:
      return kTurn;
    case GizmoMode::kScale:
      return kScale;
  }
  return kMove;
}

std::optional<GizmoHandle> PickHandle(const GizmoLayout& layout,
                                      GizmoMode mode,
                                      const ViewCamera& view,
                                      const Vector2d& pixel,
                                      GizmoFreedom freedom) {
  std::optional<GizmoHandle> picked;
  double best = GizmoLayout::kGrabPx;
  for (const GizmoHandle handle : HandlesOf(mode, freedom)) {
    const double distance = DistanceToOutline(handle, layout.Outline(handle, view), pixel);
    if (distance < best) {
      best = distance;
      picked = handle;
    }
  }
  return picked;
}

std::optional<GizmoDrag> GizmoDrag::Begin(GizmoHandle handle,
                                          const geometry::Similarity3& world_from_thing,
                                          const ViewCamera& view,
                                          const Vector2d& pixel) {
  GizmoDrag drag(handle, world_from_thing);
  const std::optional<Vector3d> parameter = drag.Parameter(view, pixel);
  if (!parameter) {
    return std::nullopt;
  }
  drag.start_parameter_ = *parameter;
  return drag;
}

std::optional<Vector3d> GizmoDrag::Parameter(const ViewCamera& view, const Vector2d& pixel) const {
  const Ray ray = view.RayThrough(pixel);
  const Vector3d origin = start_.translation;
  const Vector3d axis = start_.rotation * Vector3d::Unit(AxisOf(handle_));
  if (IsArrow(handle_)) {
    const std::optional<double> length = NearestOnAxis(ray, origin, axis);
    return length ? std::optional<Vector3d>(*length * axis) : std::nullopt;
  }
  if (handle_ == GizmoHandle::kScale) {
    constexpr double kMinPixels = 2.0;
    const std::optional<Vector2d> middle = view.Project(origin);
    if (!middle || (pixel - *middle).norm() < kMinPixels) {
      return std::nullopt;
    }
    return Vector3d((pixel - *middle).norm(), 0.0, 0.0);
  }
  const std::optional<Vector3d> hit = MeetPlane(ray, origin, axis);
  return hit ? std::optional<Vector3d>(*hit - origin) : std::nullopt;
}

std::optional<Vector3d> GizmoDrag::WayTo(const GizmoSnap::Plane& plane) const {
  constexpr double kSteep = 0.5;  // Sine of the angle to the plane.
  const Vector3d axis = start_.rotation * Vector3d::Unit(AxisOf(handle_));
  const double along = plane.normal.dot(axis);
  const Vector3d way = IsArrow(handle_) ? Vector3d(along * axis) : plane.normal - along * axis;
  return way.norm() > kSteep ? std::optional<Vector3d>(way.normalized()) : std::nullopt;
}

Vector3d GizmoDrag::SnappedMove(const Vector3d& move, const GizmoSnap& snap) const {
  Vector3d snapped = move;
  if (snap.move > 0.0) {
    const Vector3d in_axes = start_.rotation.conjugate() * move;
    snapped = start_.rotation * (snap.move * (in_axes / snap.move).array().round().matrix());
  }
  if (!snap.floor) {
    return snapped;
  }
  const GizmoSnap::Plane& floor = *snap.floor;
  const auto height = [&](const Vector3d& moved) {
    return floor.normal.dot(start_.translation + moved - floor.point);
  };
  const std::optional<Vector3d> way = WayTo(floor);
  if (way && std::abs(height(move)) < floor.reach) {
    snapped -= height(snapped) / way->dot(floor.normal) * *way;
  }
  return snapped;
}

geometry::Similarity3 GizmoDrag::Update(const ViewCamera& view,
                                        const Vector2d& pixel,
                                        const GizmoSnap& snap) {
  const std::optional<Vector3d> parameter = Parameter(view, pixel);
  if (!parameter) {
    return last_;
  }
  geometry::Similarity3 result = start_;
  if (handle_ == GizmoHandle::kScale) {
    double factor = parameter->x() / start_parameter_.x();
    if (snap.scale > 0.0) {
      factor = snap.scale * std::max(std::round(factor / snap.scale), 1.0);
    }
    result.scale = start_.scale * factor;
  } else if (IsArrow(handle_) || IsPlane(handle_)) {
    result.translation = start_.translation + SnappedMove(*parameter - start_parameter_, snap);
  } else {
    const Vector3d axis = start_.rotation * Vector3d::Unit(AxisOf(handle_));
    double angle =
        std::atan2(axis.dot(start_parameter_.cross(*parameter)), start_parameter_.dot(*parameter));
    if (snap.turn > 0.0) {
      angle = snap.turn * std::round(angle / snap.turn);
    }
    result.rotation = (Eigen::AngleAxisd(angle, axis) * start_.rotation).normalized();
  }
  last_ = result;
  return result;
}

}  // namespace lararium::panels
