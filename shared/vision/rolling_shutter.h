#pragma once

// The rolling shutter of a camera: each pixel of an image is exposed at its own time, while the
// camera moves.

#include <Eigen/Core>

#include "shared/geometry/camera_model.h"
#include "shared/geometry/transform.h"

namespace lararium::vision {

struct RollingShutter {
  // How long it takes to read an image, as a share of the frame time: from the first column to the
  // last plus one (x), or from the first row (y). Negative if the last one is read first. Zero: a
  // global shutter.
  Eigen::Vector2d readout = Eigen::Vector2d::Zero();
  // Motion of the camera in one frame time: (w, v) of the pose (exp(w) R, exp(w) t + v); radians
  // and map units.
  Eigen::Matrix<double, 6, 1> motion = Eigen::Matrix<double, 6, 1>::Zero();
};

// The place of a pixel in the order of columns and rows, as shares of the width and the height
// after the middle of the image. Its product with the readout is the time at which the pixel is
// exposed, in frame times after the middle of the image, to which the image's pose belongs.
inline Eigen::Vector2d ReadoutOrder(const geometry::CameraModel& camera,
                                    const Eigen::Vector2d& pixel) {
  return {(pixel.x() - 0.5 * (camera.width - 1)) / camera.width,
          (pixel.y() - 0.5 * (camera.height - 1)) / camera.height};
}

// The pose some frame times after the middle of the image.
geometry::Rigid3 PoseAfter(const geometry::Rigid3& camera_from_map,
                           const Eigen::Matrix<double, 6, 1>& motion,
                           double time);

}  // namespace lararium::vision
