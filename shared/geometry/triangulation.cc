#include "shared/geometry/triangulation.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "shared/core/check.h"

namespace lararium::geometry {
namespace {

// Returns the homogeneous point X that minimises the sum of squares of x (p3 X) - p1 X and y (p3 X)
// - p2 X, or nullopt for points at infinity.
std::optional<Eigen::Vector3d> TriangulateLinear(std::span<const Rigid3> camera_from_world,
                                                 std::span<const Eigen::Vector2d> plane_points) {
  Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
  for (size_t i = 0; i < plane_points.size(); ++i) {
    const Eigen::Matrix<double, 3, 4> projection = camera_from_world[i].Matrix3x4();
    // Normalises the rows, so that the weight of a view does not depend on its direction.
    const double scale = 1.0 / plane_points[i].homogeneous().norm();
    for (int axis = 0; axis < 2; ++axis) {
      const Eigen::Vector4d row =
          scale * (plane_points[i][axis] * projection.row(2) - projection.row(axis)).transpose();
      normal += row * row.transpose();
    }
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d> solver(normal);
  const Eigen::Vector4d smallest = solver.eigenvectors().col(0);
  if (std::abs(smallest.w()) < 1e-12) {
    return std::nullopt;
  }
  return smallest.hnormalized();
}

// Computes the squared error on the plane and its normal equations. Returns false if the point is
// behind a camera.
bool Linearise(std::span<const Rigid3> camera_from_world,
               std::span<const Eigen::Vector2d> plane_points,
               const Eigen::Vector3d& point,
               Eigen::Matrix3d& hessian,
               Eigen::Vector3d& gradient,
               double& error) {
  hessian.setZero();
  gradient.setZero();
  error = 0.0;
  for (size_t i = 0; i < plane_points.size(); ++i) {
    const Eigen::Matrix3d rotation = camera_from_world[i].rotation.toRotationMatrix();
    const Eigen::Vector3d in_camera = rotation * point + camera_from_world[i].translation;
    if (!(in_camera.z() > 1e-12)) {
      return false;
    }
    const Eigen::Vector2d projected = in_camera.hnormalized();
    const Eigen::Vector2d residual = projected - plane_points[i];
    Eigen::Matrix<double, 2, 3> jacobian;
    jacobian.row(0) = (rotation.row(0) - projected.x() * rotation.row(2)) / in_camera.z();
    jacobian.row(1) = (rotation.row(1) - projected.y() * rotation.row(2)) / in_camera.z();
    hessian += jacobian.transpose() * jacobian;
    gradient += jacobian.transpose() * residual;
    error += residual.squaredNorm();
  }
  return true;
}

}  // namespace

std::optional<Eigen::Vector3d> TriangulatePoint(std::span<const Rigid3> camera_from_world,
                                                std::span<const Eigen::Vector2d> plane_points) {
  CHECK(camera_from_world.size() == plane_points.size());
  if (plane_points.size() < 2) {
    return std::nullopt;
  }
  const std::optional<Eigen::Vector3d> linear = TriangulateLinear(camera_from_world, plane_points);
  if (!linear || !linear->allFinite()) {
    return std::nullopt;
  }
  Eigen::Vector3d point = *linear;
  Eigen::Matrix3d hessian;
  Eigen::Vector3d gradient;
  double error = 0.0;
  if (!Linearise(camera_from_world, plane_points, point, hessian, gradient, error)) {
    return std::nullopt;
  }
  constexpr int kMaxIterations = 10;
  for (int i = 0; i < kMaxIterations; ++i) {
    const Eigen::LDLT<Eigen::Matrix3d> factors(hessian);
    const Eigen::Vector3d pivots = factors.vectorD();
    if (!(pivots.minCoeff() > 1e-14 * pivots.maxCoeff())) {
      return std::nullopt;  // The rays do not determine the depth.
    }
    const Eigen::Vector3d step = factors.solve(gradient);
    const Eigen::Vector3d next = point - step;
    double next_error = 0.0;
    if (!Linearise(camera_from_world, plane_points, next, hessian, gradient, next_error) ||
        next_error >= error) {
      break;
    }
    point = next;
    error = next_error;
    if (step.norm() < 1e-12 * point.norm()) {
      break;
    }
  }
  return point;
}

double TriangulationAngle(const Eigen::Vector3d& center_a,
                          const Eigen::Vector3d& center_b,
                          const Eigen::Vector3d& point) {
  const Eigen::Vector3d a = center_a - point;
  const Eigen::Vector3d b = center_b - point;
  return std::atan2(a.cross(b).norm(), a.dot(b));  // exact for small angles
}

double WidestAngle(std::span<const Eigen::Vector3d> centers, const Eigen::Vector3d& point) {
  double widest = 0.0;
  for (size_t a = 0; a < centers.size(); ++a) {
    for (size_t b = a + 1; b < centers.size(); ++b) {
      widest = std::max(widest, TriangulationAngle(centers[a], centers[b], point));
    }
  }
  return widest;
}

}  // namespace lararium::geometry
