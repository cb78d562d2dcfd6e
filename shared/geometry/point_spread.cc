#include "shared/geometry/point_spread.h"

#include <Eigen/Eigenvalues>

namespace lararium::geometry {

PointSpread SpreadOf(std::span<const Eigen::Vector3d> points) {
  PointSpread spread;
  if (points.empty()) {
    return spread;
  }
  for (const Eigen::Vector3d& point : points) {
    spread.mean += point;
  }
  const auto count = static_cast<double>(points.size());
  spread.mean /= count;
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& point : points) {
    scatter += (point - spread.mean) * (point - spread.mean).transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(scatter);
  spread.axes = solver.eigenvectors();
  spread.deviations = (solver.eigenvalues() / count).cwiseMax(0.0).cwiseSqrt();
  return spread;
}

}  // namespace lararium::geometry
