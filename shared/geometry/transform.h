#pragma once

// Rigid motions and similarities. A transform is named a_from_b and maps b's
// coordinates to a's; compose by matching the inner names:
// camera_from_stage = camera_from_map * map_from_stage.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <span>

#include "shared/core/status.h"

namespace lararium::geometry {

// x_a = rotation * x_b + translation. The rotation is a unit quaternion.
struct Rigid3 {
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();

  static Rigid3 FromMatrix(const Eigen::Matrix3d& rotation, const Eigen::Vector3d& translation);

  Eigen::Vector3d operator*(const Eigen::Vector3d& point) const {
    return rotation * point + translation;
  }
  Rigid3 operator*(const Rigid3& other) const {
    return {(rotation * other.rotation).normalized(), rotation * other.translation + translation};
  }
  Rigid3 Inverse() const {
    const Eigen::Quaterniond inverse = rotation.conjugate();
    return {inverse, -(inverse * translation)};
  }
  // Returns [R | t].
  Eigen::Matrix<double, 3, 4> Matrix3x4() const;

  // For camera_from_world: the camera's centre in world coordinates.
  Eigen::Vector3d Center() const { return -(rotation.conjugate() * translation); }

  // Compares the numbers: q and -q differ although they are the same rotation.
  friend bool operator==(const Rigid3& a, const Rigid3& b) {
    return a.rotation.coeffs() == b.rotation.coeffs() && a.translation == b.translation;
  }
};

// x_a = scale * (rotation * x_b) + translation, scale > 0.
struct Similarity3 {
  double scale = 1.0;
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();

  Eigen::Vector3d operator*(const Eigen::Vector3d& point) const {
    return scale * (rotation * point) + translation;
  }
  Similarity3 operator*(const Similarity3& other) const {
    return {scale * other.scale, (rotation * other.rotation).normalized(),
            scale * (rotation * other.translation) + translation};
  }
  Similarity3 Inverse() const {
    const Eigen::Quaterniond inverse = rotation.conjugate();
    return {1.0 / scale, inverse, -(inverse * translation) / scale};
  }

  // Compares the numbers, as for Rigid3.
  friend bool operator==(const Similarity3& a, const Similarity3& b) {
    return a.scale == b.scale && a.rotation.coeffs() == b.rotation.coeffs() &&
           a.translation == b.translation;
  }
};

// Converts a camera pose from world a to world b with the similarity a_from_b. The result is rigid
// in b's units; if b is the stage it is metric. A point projects to the same pixel through both
// poses.
Rigid3 CameraFromB(const Rigid3& camera_from_a, const Similarity3& a_from_b);

// Estimates a_from_b from corresponding points by least squares (Umeyama, "Least-squares estimation
// of transformation parameters between two point patterns", PAMI 1991). Needs three points that are
// not collinear.
Result<Similarity3> EstimateSimilarity(std::span<const Eigen::Vector3d> points_in_a,
                                       std::span<const Eigen::Vector3d> points_in_b);

// The rotation nearest to a matrix by the sum of squared differences (Arun, Huang and Blostein,
// "Least-squares fitting of two 3-D point sets", PAMI 1987; the sign after Umeyama, 1991). It turns
// the points x_b nearest to x_a where matrix is the sum of x_a x_b^T.
Eigen::Quaterniond ClosestRotation(const Eigen::Matrix3d& matrix);

// The shortest rotation that turns the direction of b into that of a. Neither may be zero.
Eigen::Quaterniond RotationBetween(const Eigen::Vector3d& a, const Eigen::Vector3d& b);

// Rotation by |w| radians about w, and its inverse. |w| <= pi.
Eigen::Quaterniond RotationFromVector(const Eigen::Vector3d& w);
Eigen::Vector3d VectorFromRotation(const Eigen::Quaterniond& rotation);

// [v]x, so that Skew(v) * u = v x u.
Eigen::Matrix3d Skew(const Eigen::Vector3d& v);

}  // namespace lararium::geometry
