#pragma once

// A camera whose intrinsics are not exactly known, and the residuals of points seen by it. The
// shutter may be a rolling one: each pixel is exposed at its own time, while the camera moves.

#include <Eigen/Core>

#include "shared/geometry/camera_model.h"
#include "shared/geometry/transform.h"
#include "shared/vision/pose_refinement.h"
#include "shared/vision/rolling_shutter.h"

namespace lararium::vision {

// The parameters that can be estimated. What most cameras need most comes first, so that a prefix
// of the parameters can be estimated by itself.
enum CameraParameter {
  kReadoutX,  // CameraEstimate::readout
  kReadoutY,
  kTurnX,  // CameraEstimate::turning
  kTurnY,
  kTurnZ,
  kFocal,    // relative change of both focal lengths
  kCentreX,  // principal point, pixels
  kCentreY,
  kRadial1,  // k1
  kRadial2,  // k2
  kCameraParameters,
};
// The parameters of the shutter come first.
inline constexpr int kShutterParameters = kFocal;

using CameraVector = Eigen::Matrix<double, kCameraParameters, 1>;
using CameraMatrix = Eigen::Matrix<double, kCameraParameters, kCameraParameters>;

struct CameraEstimate {
  geometry::CameraModel model;
  Eigen::Vector2d readout = Eigen::Vector2d::Zero();  // See RollingShutter.
  // What the camera turns in one frame time beyond the motion that is given with it: radians. A
  // hand trembles so fast that the images before do not tell how the camera turns in this one, but
  // the rows of a rolling shutter do. Belongs to one image only.
  Eigen::Vector3d turning = Eigen::Vector3d::Zero();
  // Covariance of the parameters; a parameter of variance 0 is exactly known.
  CameraMatrix covariance = CameraMatrix::Zero();

  // The number of parameters, counted from the first, of which at least the last is not known.
  int Unknown() const;
  // Whether only the shutter may be unknown.
  bool LensKnown() const { return Unknown() <= kShutterParameters; }

  // The time at which a pixel is exposed, in frame times after the middle of the image.
  double TimeOf(const Eigen::Vector2d& pixel) const;
};

// An exactly known camera with a global shutter.
CameraEstimate ExactCamera(const geometry::CameraModel& model);

// Changes the parameters; the covariance stays.
CameraEstimate Changed(const CameraEstimate& camera, const CameraVector& step);
// The step with Changed(from, step) = to.
CameraVector Difference(const CameraEstimate& from, const CameraEstimate& to);

struct PosedCamera {
  geometry::Rigid3 camera_from_map;
  CameraEstimate camera;
};

// The inverse of the covariance. A known parameter has no correlation with others and a large
// number on the diagonal, so that it is estimated to be unchanged.
CameraMatrix Information(const CameraEstimate& camera);

// A pose and the first N - 6 parameters of the camera.
inline constexpr int kMostJoint = 6 + kCameraParameters;
template <int N>
using JointVector = Eigen::Matrix<double, N, 1>;
template <int N>
using JointMatrix = Eigen::Matrix<double, N, N>;
// The same of a size that is known at run time only, without memory from the heap. Eigen's
// decompositions are slow to compile; of these types they are compiled once, not for each N.
using BoundedVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMostJoint, 1>;
using BoundedMatrix =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMostJoint, kMostJoint>;
// The covariance of a pose and of a camera that is exactly known.
JointMatrix<kMostJoint> WithKnownCamera(const Matrix6d& covariance);

// The camera's motion (w, v) during one frame time, as in Moved(). nullptr: unknown, which counts
// as none.
using FrameMotion = const Vector6d*;

// A point in the camera frame of the middle of the image, moved to the camera frame of another time
// (frame times), to second order.
Eigen::Vector3d AtTimeOf(double time, const Eigen::Vector3d& in_camera, FrameMotion motion);

// The pixel at which a point in the camera frame is seen, minus the pixel at which it was observed.
// If jacobian is not null, fills in the derivative by (w, v) and the parameters. Returns false for
// a point behind the camera.
template <int N>
bool PixelResidual(const CameraEstimate& camera,
                   const Eigen::Vector3d& in_camera,
                   FrameMotion motion,
                   const Eigen::Vector2d& observed,
                   Eigen::Vector2d& residual,
                   Eigen::Matrix<double, 2, N>* jacobian) {
  const double time = N > 6 ? camera.TimeOf(observed) : 0.0;
  Vector6d in_image = Vector6d::Zero();
  if (N > 6 && motion != nullptr) {
    in_image = *motion;
    in_image.template head<3>() += camera.turning;
  }
  const Eigen::Vector3d p = N > 6 ? AtTimeOf(time, in_camera, &in_image) : in_camera;
  Eigen::Vector2d on_plane;
  Matrix26d by_pose;
  if (!PlaneResidual(p, Eigen::Vector2d::Zero(), on_plane,
                     jacobian != nullptr ? &by_pose : nullptr)) {
    return false;
  }
  if (jacobian == nullptr) {
    residual = camera.model.PixelFromPlane(on_plane) - observed;
    return true;
  }
  Eigen::Matrix2d slope;
  const Eigen::Vector2d seen = camera.model.PixelFromPlane(on_plane, slope);
  residual = seen - observed;
  jacobian->template leftCols<6>().noalias() = slope * by_pose;
  if constexpr (N > 6) {
    const geometry::CameraModel& model = camera.model;
    Eigen::Vector2d speed = Eigen::Vector2d::Zero();  // pixels per frame time
    jacobian->template middleCols<3>(6 + kTurnX).setZero();
    if (motion != nullptr) {
      // The point moves as the one of the middle of the image does, turned by what the camera has
      // turned since: A = I + t [w] + t^2 / 2 [w]^2, which multiplies each row from the right.
      const Eigen::Vector3d w = in_image.template head<3>();
      const Eigen::Vector3d across = w.cross(in_camera);
      const Eigen::Vector3d velocity =
          across + time * w.cross(across) + in_image.template tail<3>();
      for (int row = 0; row < 2; ++row) {
        const Eigen::Vector3d by_point = jacobian->template block<1, 3>(row, 3).transpose();
        const Eigen::Vector3d turned = by_point.cross(w);
        const Eigen::Vector3d by_middle =
            by_point + time * turned + 0.5 * time * time * turned.cross(w);
        jacobian->template block<1, 3>(row, 0) = in_camera.cross(by_middle).transpose();
        jacobian->template block<1, 3>(row, 3) = by_middle.transpose();
        jacobian->template block<1, 3>(row, 6 + kTurnX) =
            time * (in_camera.cross(by_point) +
                    0.5 * time * (in_camera.cross(turned) + across.cross(by_point)))
                       .transpose();
        speed[row] = by_point.dot(velocity);
      }
    }
    jacobian->template middleCols<2>(6 + kReadoutX) =
        speed * ReadoutOrder(model, observed).transpose();
    if constexpr (N > 6 + kShutterParameters) {
      const double r2 = on_plane.squaredNorm();
      const Eigen::Vector2d scaled(model.fx * on_plane.x(), model.fy * on_plane.y());
      jacobian->col(6 + kFocal) = seen - Eigen::Vector2d(model.cx, model.cy);
      jacobian->col(6 + kCentreX) = Eigen::Vector2d::UnitX();
      jacobian->col(6 + kCentreY) = Eigen::Vector2d::UnitY();
      jacobian->col(6 + kRadial1) = scaled * r2;
      jacobian->col(6 + kRadial2) = scaled * (r2 * r2);
    }
  }
  return true;
}

}  // namespace lararium::vision
