#pragma once

// Where the raw pixels of an image lie on the screen, for whoever picks in it.

#include <Eigen/Core>
#include <optional>

#include "shared/geometry/camera_model.h"

namespace lararium::panels {

struct ImageMap {
  // A picture that was drawn of the image with another camera: same place, same axes.
  struct Redrawn {
    geometry::CameraModel raw;
    geometry::CameraModel display;
  };

  Eigen::Vector2d origin;  // screen position of the picture's top-left corner
  double scale = 1.0;      // screen pixels to one of the picture
  std::optional<Redrawn> redrawn = std::nullopt;  // none: the picture is the image

  // A pixel of the image as one of the picture; integer coordinates are pixel centres.
  Eigen::Vector2d ToPicture(const Eigen::Vector2d& pixel) const {
    return redrawn ? redrawn->display.PixelFromPlane(redrawn->raw.PlaneFromPixel(pixel)) : pixel;
  }
  Eigen::Vector2d ToScreen(const Eigen::Vector2d& pixel) const {
    return origin + scale * (ToPicture(pixel) + Eigen::Vector2d(0.5, 0.5));
  }
  Eigen::Vector2d ToPixel(const Eigen::Vector2d& screen) const {
    const Eigen::Vector2d picture = (screen - origin) / scale - Eigen::Vector2d(0.5, 0.5);
    return redrawn ? redrawn->raw.PixelFromPlane(redrawn->display.PlaneFromPixel(picture))
                   : picture;
  }
};

}  // namespace lararium::panels
