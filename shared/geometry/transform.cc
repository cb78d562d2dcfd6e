#include "shared/geometry/transform.h"

#include <Eigen/SVD>
#include <cmath>

namespace lararium::geometry {

Rigid3 Rigid3::FromMatrix(const Eigen::Matrix3d& rotation, const Eigen::Vector3d& translation) {
  return {Eigen::Quaterniond(rotation).normalized(), translation};
}

Eigen::Matrix<double, 3, 4> Rigid3::Matrix3x4() const {
  Eigen::Matrix<double, 3, 4> matrix;
  matrix << rotation.toRotationMatrix(), translation;
  return matrix;
}

Rigid3 CameraFromB(const Rigid3& camera_from_a, const Similarity3& a_from_b) {
  // R_ca (s R_ab x + t_ab) + t_ca, divided by s: depth scales, pixels do not.
  return {(camera_from_a.rotation * a_from_b.rotation).normalized(),
          (camera_from_a * a_from_b.translation) / a_from_b.scale};
}

Result<Similarity3> EstimateSimilarity(std::span<const Eigen::Vector3d> points_in_a,
                                       std::span<const Eigen::Vector3d> points_in_b) {
  CHECK(points_in_a.size() == points_in_b.size());
  const auto count = static_cast<double>(points_in_a.size());
  if (points_in_a.size() < 3) {
    return Status::Error("similarity", "fewer than three points", "give three or more");
  }
  Eigen::Vector3d mean_a = Eigen::Vector3d::Zero();
  Eigen::Vector3d mean_b = Eigen::Vector3d::Zero();
  for (size_t i = 0; i < points_in_a.size(); ++i) {
    mean_a += points_in_a[i] / count;
    mean_b += points_in_b[i] / count;
  }
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  double variance_b = 0.0;
  for (size_t i = 0; i < points_in_a.size(); ++i) {
    covariance += (points_in_a[i] - mean_a) * (points_in_b[i] - mean_b).transpose() / count;
    variance_b += (points_in_b[i] - mean_b).squaredNorm() / count;
  }
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(covariance,
                                              Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Eigen::Vector3d& singular = svd.singularValues();
  if (!(singular[1] > 1e-12 * singular[0]) || !(singular[0] > 0.0)) {
    return Status::Error("similarity", "the points lie on a line", "choose points off that line");
  }
  Eigen::Vector3d sign(1.0, 1.0,
                       (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0 ? -1 : 1);
  Similarity3 a_from_b;
  a_from_b.rotation = Eigen::Quaterniond(
      Eigen::Matrix3d(svd.matrixU() * sign.asDiagonal() * svd.matrixV().transpose()));
  a_from_b.scale = singular.dot(sign) / variance_b;
  a_from_b.translation = mean_a - a_from_b.scale * (a_from_b.rotation * mean_b);
  return a_from_b;
}

Eigen::Quaterniond ClosestRotation(const Eigen::Matrix3d& matrix) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(matrix, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const bool mirrored = svd.matrixU().determinant() * svd.matrixV().determinant() < 0.0;
  const Eigen::Vector3d signs(1.0, 1.0, mirrored ? -1.0 : 1.0);
  return Eigen::Quaterniond(
      Eigen::Matrix3d(svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose()));
}

Eigen::Quaterniond RotationBetween(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return Eigen::Quaterniond::FromTwoVectors(b, a);
}

Eigen::Quaterniond RotationFromVector(const Eigen::Vector3d& w) {
  const double angle = w.norm();
  // sin(angle / 2) / angle, by its series near zero.
  const double factor = angle < 1e-6 ? 0.5 - angle * angle / 48.0 : std::sin(0.5 * angle) / angle;
  return Eigen::Quaterniond(std::cos(0.5 * angle), factor * w.x(), factor * w.y(), factor * w.z());
}

Eigen::Vector3d VectorFromRotation(const Eigen::Quaterniond& rotation) {
  const double sign = rotation.w() < 0.0 ? -1.0 : 1.0;
  const double sine = rotation.vec().norm();
  const double angle = 2.0 * std::atan2(sine, sign * rotation.w());
  const double factor = sine < 1e-9 ? 2.0 : angle / sine;
  return sign * factor * rotation.vec();
}

Eigen::Matrix3d Skew(const Eigen::Vector3d& v) {
  Eigen::Matrix3d skew;
  skew << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return skew;
}

}  // namespace lararium::geometry
