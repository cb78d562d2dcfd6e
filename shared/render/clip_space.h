#pragma once

// The one place where camera axes (x right, y down, z forward; integer
// coordinates are pixel centres) meet OpenGL's clip space (y up).

#include <glm/mat4x4.hpp>

#include "shared/geometry/camera_model.h"
#include "shared/geometry/transform.h"

namespace lararium::render {

// The projection from camera coordinates to clip space. A point that display projects to pixel
// (u, v) covers OpenGL's sample at the centre of column u and row v, counted from the top. near
// and far are in metres, 0 < near < far. The distortion of display is ignored: everything is
// drawn with a pinhole camera.
glm::mat4 ClipFromCamera(const geometry::CameraModel& display, float near, float far);

// Returns camera_from_stage of a camera at eye that looks at target; the stage direction up
// points upwards in its image. If up is parallel to the viewing direction, the roll is arbitrary.
geometry::Rigid3 LookAt(const Eigen::Vector3d& eye,
                        const Eigen::Vector3d& target,
                        const Eigen::Vector3d& up);

}  // namespace lararium::render
