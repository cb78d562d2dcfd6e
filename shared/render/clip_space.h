#pragma once

// The one place where camera axes (x right, y down, z forward; integer
// coordinates are pixel centres) meet OpenGL's clip space (y up).

#include <glm/mat4x4.hpp>

#include "shared/geometry/camera_model.h"
#include "shared/geometry/transform.h"

namespace lararium::render {

// Projects points in camera coordinates: what display projects to pixel (u, v)
// covers OpenGL's sample at the centre of column u and row v from the top. near,
// far: metres, 0 < near < far. display's distortion is not used: everything
// drawn is pinhole.
glm::mat4 ClipFromCamera(const geometry::CameraModel& display, float near, float far);

// camera_from_stage of a camera at eye that looks at target with up (of the
// stage) upwards in its image. Any roll when up is parallel to the view.
geometry::Rigid3 LookAt(const Eigen::Vector3d& eye,
                        const Eigen::Vector3d& target,
                        const Eigen::Vector3d& up);

}  // namespace lararium::render
