#include "shared/render/clip_space.h"

#include "shared/core/check.h"

namespace lararium::render {

glm::mat4 ClipFromCamera(const geometry::CameraModel& display, float near, float far) {
  CHECK(near > 0.0f && far > near);
  const double sx = 2.0 / display.width;
  const double sy = 2.0 / display.height;
  glm::mat4 clip(0.0f);  // [column][row]
  clip[0][0] = static_cast<float>(sx * display.fx);
  clip[1][1] = static_cast<float>(-sy * display.fy);
  clip[2][0] = static_cast<float>(sx * (display.cx + 0.5) - 1.0);
  clip[2][1] = static_cast<float>(1.0 - sy * (display.cy + 0.5));
  clip[2][2] = (far + near) / (far - near);
  clip[2][3] = 1.0f;
  clip[3][2] = -2.0f * far * near / (far - near);
  return clip;
}

geometry::Rigid3 LookAt(const Eigen::Vector3d& eye,
                        const Eigen::Vector3d& target,
                        const Eigen::Vector3d& up) {
  const Eigen::Vector3d forward = (target - eye).normalized();
  Eigen::Vector3d right = forward.cross(up);
  if (right.norm() < 1e-9) {
    right = forward.unitOrthogonal();
  }
  right.normalize();
  Eigen::Matrix3d camera_from_stage;
  camera_from_stage << right.transpose(), forward.cross(right).transpose(), forward.transpose();
  return geometry::Rigid3::FromMatrix(camera_from_stage, -(camera_from_stage * eye));
}

}  // namespace lararium::render
