#include "shared/vision/camera_estimate.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>

namespace lararium::vision {

int CameraEstimate::Unknown() const {
  int count = kCameraParameters;
  while (count > 0 && covariance(count - 1, count - 1) == 0.0) {
    --count;
  }
  return count;
}

double CameraEstimate::TimeOf(const Eigen::Vector2d& pixel) const {
  return readout.dot(ReadoutOrder(model, pixel));
}

CameraEstimate ExactCamera(const geometry::CameraModel& model) {
  CameraEstimate camera;
  camera.model = model;
  return camera;
}

CameraEstimate Changed(const CameraEstimate& camera, const CameraVector& step) {
  CameraEstimate changed = camera;
  changed.readout += Eigen::Vector2d(step[kReadoutX], step[kReadoutY]);
  changed.turning += step.segment<3>(kTurnX);
  const double factor = std::exp(step[kFocal]);
  changed.model.fx *= factor;
  changed.model.fy *= factor;
  changed.model.cx += step[kCentreX];
  changed.model.cy += step[kCentreY];
  changed.model.k1 += step[kRadial1];
  changed.model.k2 += step[kRadial2];
  return changed;
}

CameraVector Difference(const CameraEstimate& from, const CameraEstimate& to) {
  CameraVector step;
  step[kReadoutX] = to.readout.x() - from.readout.x();
  step[kReadoutY] = to.readout.y() - from.readout.y();
  step.segment<3>(kTurnX) = to.turning - from.turning;
  step[kFocal] = std::log(to.model.Focal() / from.model.Focal());
  step[kCentreX] = to.model.cx - from.model.cx;
  step[kCentreY] = to.model.cy - from.model.cy;
  step[kRadial1] = to.model.k1 - from.model.k1;
  step[kRadial2] = to.model.k2 - from.model.k2;
  return step;
}

CameraMatrix Information(const CameraEstimate& camera) {
  constexpr double kKnown = 1e-12;
  CameraMatrix covariance = camera.covariance;
  for (int i = 0; i < kCameraParameters; ++i) {
    if (covariance(i, i) == 0.0) {
      covariance(i, i) = kKnown;
    }
  }
  // Pixels and coefficients differ by orders of magnitude.
  const CameraVector scale = covariance.diagonal().cwiseSqrt().cwiseInverse();
  const CameraMatrix even = scale.asDiagonal() * covariance * scale.asDiagonal();
  return scale.asDiagonal() * even.inverse() * scale.asDiagonal();
}

JointMatrix<kMostJoint> WithKnownCamera(const Matrix6d& covariance) {
  JointMatrix<kMostJoint> joint = JointMatrix<kMostJoint>::Zero();
  joint.topLeftCorner<6, 6>() = covariance;
  return joint;
}

Eigen::Vector3d AtTimeOf(double time, const Eigen::Vector3d& in_camera, FrameMotion motion) {
  if (motion == nullptr || time == 0.0) {
    return in_camera;
  }
  const Eigen::Vector3d w = time * motion->head<3>();
  const Eigen::Vector3d across = w.cross(in_camera);
  return in_camera + across + 0.5 * w.cross(across) + time * motion->tail<3>();
}

}  // namespace lararium::vision
